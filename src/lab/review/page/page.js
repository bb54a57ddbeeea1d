"use strict";
for (const viewer of document.querySelectorAll(".viewer")) {
  const find = (name) => viewer.querySelector(name);
  const tools = find(".tools"), shots = find(".shots");
  if (!tools) continue;
  tools.hidden = false;
  const width = Number(find("img").getAttribute("width"));
  let zoom = Math.max(1, Math.min(6, Math.floor(Math.min(shots.clientWidth, 960) / width / (shots.clientWidth > 700 ? 2 : 1))));
  const enlarge = (to) => {
    zoom = Math.max(1, Math.min(16, to));
    shots.style.setProperty("--zoom", zoom);
    find("output").textContent = zoom + "×";
  };
  const show = (mode) => {
    viewer.dataset.mode = mode;
    tools.querySelector(`[value="${mode}"]`).checked = true;
  };
  const range = find("input[type=range]");
  const move = () => shots.style.setProperty("--at", range.value + "%");
  const swap = () => viewer.classList.toggle("swapped");
  for (const radio of tools.querySelectorAll("input[type=radio]")) {
    radio.addEventListener("change", () => show(radio.value));
  }
  range.addEventListener("input", move);
  find(".swap").addEventListener("click", swap);
  find(".smaller").addEventListener("click", () => enlarge(zoom - 1));
  find(".larger").addEventListener("click", () => enlarge(zoom + 1));
  find(".framing")?.addEventListener("change", (event) => viewer.classList.toggle("unframed", !event.target.checked));
  viewer.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const modes = ["side", "swipe", "blend", "toggle", "difference"];
    if (modes[event.key - 1]) show(modes[event.key - 1]);
    else if (event.key === "+" || event.key === "=") enlarge(zoom + 1);
    else if (event.key === "-") enlarge(zoom - 1);
    else if (event.key === "t") swap();
    else return;
    event.preventDefault();
  });
  move();
  enlarge(zoom);
}
