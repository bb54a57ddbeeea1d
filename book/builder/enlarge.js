// The list of a page's headings leaves out those that are folded away.
addEventListener("DOMContentLoaded", () => {
  for (const link of document.querySelectorAll(".header-in-summary")) {
    const heading = document.getElementById(decodeURIComponent(link.hash.slice(1)));
    if (heading?.closest("details")) { link.closest("li").remove(); }
  }
});

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
