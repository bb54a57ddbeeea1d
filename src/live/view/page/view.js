// The page of the viewer: it shows frames as they come, and sends what the reader does as orders.
"use strict";

const part = (id) => document.getElementById(id);
const picture = part("picture");
const context = picture.getContext("2d", { alpha: false });
const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

/** Makes an element with a class and children, which are texts or elements. */
const make = (tag, name, ...children) => {
  const element = document.createElement(tag);
  if (name) element.className = name;
  element.append(...children);
  return element;
};

// ---- Orders ----

/** Sends an order; the answer is what the viewer says, and an error its sentence. */
const order = async (what) => {
  const sent = { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(what) };
  const answer = await fetch("order", sent);
  if (!answer.ok) throw new Error(await answer.text());
  return answer.json();
};

const complain = (error) => {
  part("message").textContent = error ? error.message ?? error : "";
  part("message").hidden = !error;
  fit();
};

/** How many choices were made, and how many of them the program has not answered yet. */
let [choices, unanswered] = [0, 0];

/** Sends an order that changes what can be chosen, shows a refusal, and reads the sheet again either way. */
const choose = async (what) => {
  [choices, unanswered] = [choices + 1, unanswered + 1];
  const made = choices;
  try {
    await order(what);
    if (made === choices) complain(null);
  } catch (error) {
    complain(error);
  }
  unanswered -= 1;
  await readSheet();
};

// ---- Frames ----

let sheet = null;
let shownChange = 0;
let resized = false;
const awaited = [];

const show = (buffer) => {
  const length = new DataView(buffer).getUint32(0, true);
  const told = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const [width, height] = told.size;
  if (told.error) {
    complain(told.error);
  } else {
    resized = picture.width !== width || picture.height !== height;
    if (resized) [picture.width, picture.height] = [width, height];
    context.putImageData(new ImageData(new Uint8ClampedArray(buffer, 4 + length), width, height), 0, 0);
  }
  measure(told.change);
  describe(told, width, height);
  showScale(told.scale);
  showError(told.rel_mse);
  if (told.pixels.length) showReadings(told.pixels);
  return told;
};

/** How long the frame took that shows what the reader did. */
const measure = (change) => {
  while (awaited.length && awaited[0].change <= change) {
    const took = performance.now() - awaited.shift().since;
    document.body.dataset.latency = took.toFixed(1);
    part("latency").textContent = `input to frame ${took.toFixed(0)} ms`;
  }
};

/** Whether the last frame had all of its samples, and the page shows them at their full size. */
let taken = false;
const settle = () => {
  const whole = sheet !== null && `${sheet.size[0]}x${sheet.size[1]}` === document.body.dataset.size;
  document.body.dataset.done = taken && whole;
};

const describe = (told, width, height) => {
  const [samples, of] = told.samples;
  part("samples").textContent = `${width} × ${height}, ${samples} of ${of} ${of === 1 ? "sample" : "samples"}`;
  part("cost").textContent = `${told.milliseconds.toFixed(told.milliseconds < 10 ? 1 : 0)} ms a frame`;
  part("bar").style.width = `${of ? (100 * samples) / of : 0}%`;
  document.body.dataset.frame = told.frame;
  document.body.dataset.change = told.change;
  document.body.dataset.size = `${width}x${height}`;
  taken = samples >= of;
  settle();
  if (resized) fit();
  for (const [name, milliseconds] of told.stages) {
    const cell = costs.get(name);
    if (cell) cell.textContent = milliseconds.toFixed(milliseconds < 10 ? 2 : 0);
  }
  if (told.change !== shownChange) {
    shownChange = told.change;
    if (!document.body.classList.contains("moving")) readSheetSoon();
  }
};

const follow = async () => {
  let after = 0;
  for (;;) {
    try {
      const answer = await fetch(`frame?after=${after}`);
      if (answer.status === 200) after = show(await answer.arrayBuffer()).frame;
      else if (answer.status !== 204) throw new Error(await answer.text());
      document.body.classList.remove("lost");
    } catch {
      document.body.classList.add("lost");
      part("samples").textContent = "pinhole does not answer: it may have been stopped";
      await pause(1000);
    }
  }
};

// ---- What can be chosen ----

const costs = new Map();
let readTimer = 0;

const readSheetSoon = () => {
  clearTimeout(readTimer);
  readTimer = setTimeout(() => readSheet().catch(() => {}), 250);
};

/** One reading after the other, so that none shows what was before a later one. */
let reading = Promise.resolve();
const readSheet = () => {
  clearTimeout(readTimer);
  reading = reading.catch(() => {}).then(showSheet);
  return reading;
};

const showSheet = async () => {
  const [before, made, waits] = [sheet, choices, unanswered > 0];
  const told = await (await fetch("sheet")).json();
  // It may say what was before a choice, and a box that shows so is clicked in vain; a reading follows each choice.
  if (waits || unanswered || made !== choices) return;
  sheet = told;
  document.title = `${sheet.scene} · pinhole`;
  part("scene").textContent = sheet.scene;
  part("modes").replaceChildren(...sheet.modes.map(([key, name]) => {
    const button = make("button", "", make("kbd", "", key), name);
    button.setAttribute("aria-pressed", key === sheet.mode);
    button.addEventListener("click", () => choose({ mode: key }));
    return button;
  }));
  if (!looking && sheet.change >= lookChange) look = sheet.look;
  listColumns();
  showLook();
  drawRegion(sheet.region);
  part("pause").setAttribute("aria-pressed", sheet.paused);
  part("fill").setAttribute("aria-pressed", sheet.fills);
  [part("undo").disabled, part("redo").disabled] = sheet.undo.map((steps) => steps === 0);
  document.body.dataset.paused = sheet.paused;
  if (pins.length && before?.change !== sheet.change) setPins(pins);
  else if (!before && sheet.pins.length) setPins(sheet.pins);
  else listReadings();
  if (before && before.change !== sheet.change && readings[0]) trace();
  listStages();
  if (before?.text !== sheet.text && (before === null || part("text").value === before.text)) setText(sheet.text);
  fit();
  settle();
  keepAddress();
};

const listStages = () => {
  const earlier = new Map([...costs].map(([name, cell]) => [name, cell.textContent]));
  costs.clear();
  const row = ({ name, kept, offered, reason }) => {
    const [box, cost] = [document.createElement("input"), make("td", "number", kept ? earlier.get(name) ?? "" : "")];
    box.type = "checkbox";
    box.checked = offered;
    box.title = offered ? "Take it out of the offer" : "Offer it again";
    box.setAttribute("aria-label", name);
    box.addEventListener("change", () => choose({ stage: [name, box.checked] }));
    if (kept) costs.set(name, cost);
    return make("tr", "", make("td", "", kept || !offered ? box : ""), make("td", "", name, make("small", "", reason)), cost);
  };
  const shown = sheet.stages.filter(({ kept, offered }) => kept || !offered);
  const rest = sheet.stages.filter(({ kept, offered }) => !kept && offered);
  part("kept").replaceChildren(...shown.map(row));
  part("dropped").replaceChildren(...rest.map(row));
  document.querySelector("#stages summary").textContent = `${rest.length} further stages, which this scene does not need`;
};

for (const tab of document.querySelectorAll("nav button")) {
  tab.addEventListener("click", () => {
    for (const other of document.querySelectorAll("nav button")) {
      other.setAttribute("aria-selected", other === tab);
      part(other.dataset.panel).hidden = other !== tab;
    }
  });
}
