// The arrow keys, the space bar and the page keys go to the next slide or to the one before.
addEventListener("keydown", (event) => {
  const forward = ["ArrowRight", "ArrowDown", "PageDown", " "].includes(event.key);
  if (!forward && !["ArrowLeft", "ArrowUp", "PageUp"].includes(event.key)) { return; }
  const slides = [...document.querySelectorAll("section")];
  const shown = slides.findLastIndex((slide) => slide.getBoundingClientRect().top < innerHeight / 2);
  slides[shown + (forward ? 1 : -1)]?.scrollIntoView();
  event.preventDefault();
});
// A formula that is wider than its slide is set smaller; in ems, so that this holds on paper, too.
const fit = () => document.querySelectorAll("math").forEach((formula) => {
  formula.style.fontSize = "";
  const room = formula.closest(".body, h1, h2")?.clientWidth ?? Infinity;
  const wide = Math.max(formula.getBoundingClientRect().width, formula.closest(".formula")?.scrollWidth ?? 0);
  const size = (element) => parseFloat(getComputedStyle(element).fontSize);
  if (wide > room) { formula.style.fontSize = `${0.98 * room / wide * size(formula) / size(formula.parentElement)}em`; }
});
addEventListener("resize", fit);
document.fonts.ready.then(fit);
