// Controls for the figures whose values a reader can move; pages that are served have this script, and no others.
(async (address) => {
  "use strict";
  // The samples of a pixel, frame after frame, up to those of the scene.
  const STEPS = [1, 4, 16, 64, 256, 1024];
  // A frame of more samples is given up for a newer one.
  const QUICK = 4;

  const made = (kind, properties, ...inside) => {
    const element = Object.assign(document.createElement(kind), properties);
    element.append(...inside);
    return element;
  };

  const range = (move, changed) => {
    const whole = /^-?\d+$/.test(move.start);
    const [to, from] = move.log ? [Math.log10, (x) => 10 ** x] : [(x) => x, (x) => x];
    const input = made("input", { type: "range", min: to(move.from), max: to(move.to) });
    input.step = whole && !move.log ? 1 : "any";
    const output = made("output", {});
    let value;
    const show = (text) => {
      value = text;
      const number = Number.isFinite(Number(text)) ? String(Number(Number(text).toPrecision(3))) : "∞";
      output.textContent = number.replace("-", "−") + move.unit;
      input.setAttribute("aria-valuetext", output.textContent);
    };
    input.addEventListener("input", () => {
      const exact = from(Number(input.value));
      const rounded = whole ? Math.round(exact) : Number(exact.toPrecision(3));
      show(String(Math.min(move.to, Math.max(move.from, rounded))));
      changed();
    });
    const reset = () => {
      input.value = Number.isFinite(Number(move.start)) ? to(Number(move.start)) : input.max;
      show(move.start);
    };
    return { elements: [input, output], reset, value: () => value, moved: () => value !== move.start };
  };

  const choice = (move, changed) => {
    const select = made("select", {}, ...move.choices.map((word) => made("option", { textContent: word, value: word })));
    select.addEventListener("input", changed);
    const reset = () => { select.value = move.start; };
    return { elements: [select], reset, value: () => select.value, moved: () => select.value !== move.start };
  };

  const control = (figure, { command, samples: own, moves }) => {
    const image = figure.querySelector("img");
    const code = figure.querySelector(".made code");
    const typed = code.innerHTML;
    const note = made("p", { className: "note" });
    note.setAttribute("role", "status");
    let wanted = 0, running = false, quick = true, abort = new AbortController();

    const values = () => controls.map((each) => each.value());

    const steps = () => {
      const at = moves.findIndex((move) => move.path === "camera.sampling.samples");
      const most = at < 0 ? own : Number(controls[at].value());
      return [...STEPS.filter((count) => count < most), most];
    };

    const frame = async (count) => {
      quick = count <= QUICK;
      const asked = values().join(" ");
      const query = `figure=${encodeURIComponent(figure.dataset.live)}&samples=${count}${values().map((value) => `&value=${encodeURIComponent(value)}`).join("")}`;
      abort = new AbortController();
      const answer = await fetch(`${address}?${query}`, { signal: abort.signal });
      if (answer.status === 204) { return false; }
      if (!answer.ok) { throw new Error(await answer.text()); }
      const before = image.src;
      image.src = URL.createObjectURL(await answer.blob());
      await image.decode();
      if (before.startsWith("blob:")) { URL.revokeObjectURL(before); }
      note.textContent = "";
      Object.assign(figure.dataset, { samples: count, shown: asked });
      figure.dataset.frame = Number(figure.dataset.frame || 0) + 1;
      return true;
    };

    const run = async () => {
      if (running) { return; }
      running = true;
      for (let begun = -1; begun !== wanted;) {
        begun = wanted;
        try {
          for (const count of steps()) {
            if (!await frame(count) || begun !== wanted) { break; }
          }
        } catch (error) {
          if (error.name !== "AbortError") { note.textContent = error.message; }
        }
      }
      running = false;
    };

    const changed = () => {
      const set = moves.map((move, at) => [move.path, controls[at]]).filter(([, each]) => each.moved());
      const words = set.map(([path, each]) => `--set ${path.includes(" ") ? `'${path}=${each.value()}'` : `${path}=${each.value()}`}`);
      code.innerHTML = typed;
      code.append(...words.flatMap((word) => [" ", made("span", { textContent: word })]));
      wanted += 1;
      figure.dataset.asked = values().join(" ");
      if (!quick) { abort.abort(); }
      run();
    };

    const controls = moves.map((move) => (move.choices.length ? choice : range)(move, changed));
    const rows = controls.map((each, at) => made("label", {}, made("span", { textContent: moves[at].label }), ...each.elements));
    const reset = made("button", { type: "button", textContent: "Reset" });
    reset.addEventListener("click", () => {
      controls.forEach((each) => each.reset());
      changed();
    });
    controls.forEach((each) => each.reset());
    const head = made("div", { className: "head" }, made("span", { textContent: "Move the values" }), reset);
    const panel = made("div", { className: "moves" }, head, ...rows, note);
    // mdBook turns the page by the arrow keys.
    panel.addEventListener("keydown", (event) => event.stopPropagation());
    // A picture of another size takes the same place, so that nothing below it jumps.
    if (moves.some((move) => move.path.includes(".resolution."))) {
      const [width, height] = ["width", "height"].map((name) => image.getAttribute(name));
      image.style.cssText = `width: ${width}px; aspect-ratio: ${width} / ${height}; object-fit: contain; object-position: left; image-rendering: pixelated`;
      image.removeAttribute("width");
      image.removeAttribute("height");
    }
    image.after(panel);
  };

  const figures = [...document.querySelectorAll("figure[data-live]")];
  if (!figures.length) { return; }
  const declared = await (await fetch("/figures/live.json")).json();
  for (const figure of figures) {
    const told = declared[figure.dataset.live];
    if (told) { control(figure, told); }
  }
})(LIVE_ADDRESS);
