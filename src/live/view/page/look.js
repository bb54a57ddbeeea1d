// How the film is shown: exposure, curve, false colour with its scale, and what it is compared with.
"use strict";

let look = { exposure: 0, automatic: false, curve: "scene", range: null, compare: "render" };
/** What the curves are called, beside the words of the command line. */
const CURVES = { scene: "as the scene says", none: "sRGB", gamma: "gamma 2.2" };
let looking = false;
let lookAgain = false;
/** The change that the last look made: a sheet from before it says nothing of it. */
let lookChange = 0;

/** Sends how the film is to be shown; one order at a time. */
const setLook = async (change, time = performance.now()) => {
  const before = look;
  look = { ...look, ...change };
  showLook();
  lookAgain = true;
  if (looking) return;
  looking = true;
  while (lookAgain) {
    lookAgain = false;
    try {
      const sent = look;
      lookChange = await order({ look: sent });
      wait(lookChange, time);
      if (sheet) sheet.look = sent;
      complain(null);
    } catch (error) {
      complain(error);
      look = before;
      showLook();
    }
  }
  looking = false;
  keepAddress();
};

const showLook = () => {
  part("exposure").value = look.exposure;
  if (document.activeElement !== part("stops")) part("stops").value = Number(look.exposure.toFixed(2));
  if (sheet && part("curve").options.length !== sheet.curves.length) part("curve").replaceChildren(...sheet.curves.map((word) => new Option(CURVES[word] ?? word, word)));
  part("curve").value = look.curve;
  part("auto").checked = look.automatic;
  part("automatic").checked = look.range === null;
  for (const button of document.querySelectorAll("[data-compare]")) {
    button.setAttribute("aria-pressed", button.dataset.compare === look.compare);
    button.hidden = !sheet?.reference;
  }
  part("forget").hidden = !sheet?.reference;
};

part("exposure").addEventListener("input", (event) => setLook({ exposure: Number(event.target.value) }, event.timeStamp));
part("stops").addEventListener("input", (event) => {
  if (event.target.value !== "") setLook({ exposure: Number(event.target.value) }, event.timeStamp);
});
part("auto").addEventListener("change", (event) => setLook({ automatic: event.target.checked }, event.timeStamp));
part("curve").addEventListener("change", (event) => setLook({ curve: event.target.value }, event.timeStamp));

const expose = (by) => setLook({ exposure: Math.max(-32, Math.min(32, look.exposure + by)) });
const nextCurve = () => {
  const curves = [...part("curve").options].map(({ value }) => value);
  setLook({ curve: curves[(curves.indexOf(look.curve) + 1) % curves.length] });
};

// ---- False colour ----

/** The column and its component that are painted, or "" and a number of the picture. */
const painted = () => {
  const [column, component] = (sheet.column ?? "").split(".");
  return { column, component: component ?? "" };
};

const paint = (column, component) => choose({ column: component ? `${column}.${component}` : column || null });

const listColumns = () => {
  const { column, component } = painted();
  part("columns").replaceChildren(...["", ...sheet.columns.map(({ name }) => name)].map((name) => new Option(name || "the picture", name)));
  part("columns").value = column;
  const own = sheet.columns.find(({ name }) => name === column);
  const needsReference = (name) => ["difference", "relative square"].includes(name) && !sheet.reference;
  const names = column ? own?.components ?? [] : sheet.quantities.map(([name]) => name).filter((name) => !needsReference(name));
  part("component").replaceChildren(new Option(column ? "in its own colours" : "in colour", ""), ...names.map((name) => new Option(name, name)));
  part("component").value = component;
  const unit = column ? `${own?.unit ?? ""} (${own?.space ?? ""})` : sheet.quantities.find(([name]) => name === component)?.[1] ?? "";
  part("unit").textContent = `${`${column} ${component}`.trim()}: ${unit}`;
  part("legend").hidden = !component;
  for (const id of ["exposure", "stops", "auto", "curve"]) part(id).disabled = Boolean(column || component);
};

part("columns").addEventListener("change", (event) => paint(event.target.value, ""));
part("component").addEventListener("change", (event) => paint(painted().column, event.target.value));

/** The next of a list's values, or the one before. */
const step = (list, by) => {
  const { options, selectedIndex } = part(list);
  return options[(selectedIndex + by + options.length) % options.length].value;
};
const nextColumn = (by) => paint(step("columns", by), "");
const nextComponent = () => paint(painted().column, step("component", 1));

const short = (number) => {
  if (number === null || number === undefined || Number.isNaN(number)) return "none";
  const size = Math.abs(number);
  return number !== 0 && (size < 1e-3 || size >= 1e6) ? number.toExponential(3) : String(Number(number.toPrecision(5)));
};

const showScale = (scale) => {
  if (!scale) return;
  const [least, most] = scale.range;
  for (const [id, number] of [["least", least], ["most", most]]) {
    if (document.activeElement !== part(id)) part(id).value = Number(number.toPrecision(5));
  }
  part("half").textContent = short((least + most) / 2);
  part("found").textContent = `there: ${short(scale.numbers[0])} to ${short(scale.numbers[1])}`;
  [document.body.dataset.least, document.body.dataset.most] = scale.range;
};

for (const id of ["least", "most"]) {
  part(id).addEventListener("change", () => {
    const range = [Number(part("least").value), Number(part("most").value)];
    if (part("least").value !== "" && part("most").value !== "") setLook({ range });
  });
}
const automatic = () => setLook({ range: look.range ? null : [Number(part("least").value), Number(part("most").value)] });
part("automatic").addEventListener("change", automatic);

const drawColours = async () => {
  const hex = await (await fetch("viridis")).text();
  const canvas = part("colours").getContext("2d");
  const bytes = Uint8ClampedArray.from({ length: 1024 }, (_, at) => (at % 4 === 3 ? 255 : parseInt(hex.substr(6 * (at >> 2) + 2 * (at % 4), 2), 16)));
  canvas.putImageData(new ImageData(bytes, 256, 1), 0, 0);
};

// ---- A and B ----

const showError = (error) => {
  const name = sheet?.reference;
  part("error").textContent = name ? `reference: ${name}${error === null ? "" : `; relMSE ${error.toExponential(3)}`}` : "";
  document.body.dataset.error = error ?? "";
};

const compare = (what) => setLook({ compare: look.compare === what ? "render" : what });
for (const button of document.querySelectorAll("[data-compare]")) {
  button.addEventListener("click", () => setLook({ compare: button.dataset.compare }));
}
part("keep").addEventListener("click", () => choose({ reference: true }));
part("forget").addEventListener("click", () => choose({ reference: false }));
