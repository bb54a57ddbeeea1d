// A picture that is clicked, or chosen with Enter, is shown as large as the window; Escape or a click ends it.
(() => {
  const dialog = document.createElement("dialog");
  dialog.className = "enlarged";
  dialog.addEventListener("click", () => dialog.close());
  document.body.append(dialog);
  for (const picture of document.querySelectorAll(".drawing > svg, figure > img")) {
    const enlarge = () => {
      dialog.replaceChildren(picture.cloneNode(true));
      dialog.showModal();
    };
    picture.tabIndex = 0;
    picture.addEventListener("click", enlarge);
    picture.addEventListener("keydown", (event) => {
      if (event.key === "Enter") { enlarge(); }
    });
  }
})();
