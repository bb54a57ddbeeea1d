// The arrow keys, the space bar and the page keys go to the next slide or to the one before.
addEventListener("keydown", (event) => {
  const forward = ["ArrowRight", "ArrowDown", "PageDown", " "].includes(event.key);
  if (!forward && !["ArrowLeft", "ArrowUp", "PageUp"].includes(event.key)) { return; }
  const slides = [...document.querySelectorAll("section")];
  const shown = slides.findLastIndex((slide) => slide.getBoundingClientRect().top < innerHeight / 2);
  slides[shown + (forward ? 1 : -1)]?.scrollIntoView();
  event.preventDefault();
});
