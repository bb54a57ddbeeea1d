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

/** Sends an order that changes what can be chosen, shows a refusal, and reads the sheet again either way. */
const choose = async (what) => {
  try {
    await order(what);
    complain(null);
  } catch (error) {
    complain(error);
  }
  await readSheet();
};

// ---- Frames ----

let sheet = null;
let shownChange = 0;
const awaited = [];

const show = (buffer) => {
  const length = new DataView(buffer).getUint32(0, true);
  const told = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const [width, height] = told.size;
  if (told.error) {
    complain(told.error);
  } else {
    if (picture.width !== width || picture.height !== height) [picture.width, picture.height] = [width, height];
    context.putImageData(new ImageData(new Uint8ClampedArray(buffer, 4 + length), width, height), 0, 0);
  }
  measure(told.change);
  describe(told, width, height);
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

const describe = (told, width, height) => {
  const [samples, of] = told.samples;
  part("samples").textContent = `${width} × ${height}, ${samples} of ${of} ${of === 1 ? "sample" : "samples"}`;
  part("cost").textContent = `${told.milliseconds.toFixed(told.milliseconds < 10 ? 1 : 0)} ms a frame`;
  part("bar").style.width = `${of ? (100 * samples) / of : 0}%`;
  document.body.dataset.frame = told.frame;
  document.body.dataset.change = told.change;
  document.body.dataset.size = `${width}x${height}`;
  document.body.dataset.done = samples >= of && sheet !== null && width === sheet.size[0];
  const coarse = sheet && width < sheet.size[0];
  picture.style.imageRendering = !coarse && picture.clientWidth > 2.5 * width ? "pixelated" : "auto";
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

// ---- The camera ----

let moves = { orbit: [0, 0], pan: [0, 0], zoom: 1 };
let since = null;
let sending = false;

const still = () => ({ orbit: [0, 0], pan: [0, 0], zoom: 1 });
const isStill = ({ orbit, pan, zoom }) => !orbit[0] && !orbit[1] && !pan[0] && !pan[1] && zoom === 1;

/** Sends what has come together since the last time; one order at a time, so that none waits for another. */
const move = async (time) => {
  since ??= time;
  if (sending) return;
  sending = true;
  while (!isStill(moves)) {
    const [now, began] = [moves, since];
    [moves, since] = [still(), null];
    try {
      let change = 0;
      if (now.orbit[0] || now.orbit[1]) change = await order({ orbit: now.orbit });
      if (now.pan[0] || now.pan[1]) change = await order({ pan: now.pan });
      if (now.zoom !== 1) change = await order({ zoom: now.zoom });
      awaited.push({ change, since: began });
      measure(Number(document.body.dataset.change ?? 0));
    } catch (error) {
      complain(error);
      break;
    }
  }
  [sending, since] = [false, null];
};

const place = (event) => {
  const { left, top, width, height } = picture.getBoundingClientRect();
  return [(event.clientX - left) / width, (event.clientY - top) / height];
};

let held = null;
let pointer = [0.5, 0.5];

picture.addEventListener("pointerdown", (event) => {
  picture.setPointerCapture(event.pointerId);
  picture.classList.add("held");
  picture.focus();
  held = { x: event.clientX, y: event.clientY, pan: event.button === 2 || event.shiftKey };
  event.preventDefault();
});

picture.addEventListener("pointermove", (event) => {
  pointer = place(event);
  if (!held) return trace();
  const height = picture.getBoundingClientRect().height;
  const drag = held.pan ? moves.pan : moves.orbit;
  drag[0] += (event.clientX - held.x) / height;
  drag[1] += (event.clientY - held.y) / height;
  [held.x, held.y] = [event.clientX, event.clientY];
  move(event.timeStamp);
});

for (const end of ["pointerup", "pointercancel"]) {
  picture.addEventListener(end, () => {
    held = null;
    picture.classList.remove("held");
  });
}
picture.addEventListener("contextmenu", (event) => event.preventDefault());
picture.addEventListener("wheel", (event) => {
  event.preventDefault();
  const lines = event.deltaMode === 1 ? 16 : 1;
  moves.zoom *= Math.exp(Math.max(-200, Math.min(200, event.deltaY * lines)) * 0.0015);
  move(event.timeStamp);
}, { passive: false });

const focusOn = () => order({ focus: pointer }).then(() => complain(null), complain);
picture.addEventListener("dblclick", focusOn);

const keys = {
  "0": () => choose("reset"),
  "+": (time) => { moves.zoom *= 0.9; move(time); },
  "=": (time) => { moves.zoom *= 0.9; move(time); },
  "-": (time) => { moves.zoom /= 0.9; move(time); },
  "f": focusOn,
  "v": () => putView(),
  "?": () => part("keys").showModal(),
};

document.addEventListener("keydown", (event) => {
  const typing = event.target.matches("textarea, input, select");
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") {
    event.preventDefault();
    return save();
  }
  if ((event.ctrlKey || event.metaKey) && event.key === "Enter") return apply();
  if (typing || event.ctrlKey || event.metaKey || event.altKey || part("keys").open) return;
  const mode = sheet?.modes.find(([key]) => key === event.key);
  if (mode) return choose({ mode: mode[0] });
  keys[event.key.toLowerCase()]?.(event.timeStamp);
});
part("help").addEventListener("click", () => part("keys").showModal());

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
  const before = sheet;
  sheet = await (await fetch("sheet")).json();
  document.title = `${sheet.scene} · pinhole`;
  part("scene").textContent = sheet.scene;
  part("modes").replaceChildren(...sheet.modes.map(([key, name]) => {
    const button = make("button", "", make("kbd", "", key), name);
    button.setAttribute("aria-pressed", key === sheet.mode);
    button.addEventListener("click", () => choose({ mode: key }));
    return button;
  }));
  const columns = ["", ...sheet.columns].map((name) => new Option(name || "the picture", name));
  part("columns").replaceChildren(...columns);
  part("columns").value = sheet.column ?? "";
  listStages();
  if (before?.text !== sheet.text && (before === null || part("text").value === before.text)) setText(sheet.text);
  fit();
};

part("columns").addEventListener("change", (event) => choose({ column: event.target.value || null }));

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

/** The picture fills its place without changing its proportions. */
const fit = () => {
  if (!sheet) return;
  const [width, height] = sheet.size;
  const narrow = matchMedia("(max-width: 900px)").matches;
  const below = ["status", "message"].reduce((sum, id) => sum + part(id).offsetHeight + 8, 32);
  const factor = Math.min(part("frame").clientWidth / width, narrow ? Infinity : (part("stage").clientHeight - below) / height);
  picture.style.width = `${Math.floor(width * factor)}px`;
  picture.style.height = `${Math.floor(height * factor)}px`;
};
addEventListener("resize", fit);

for (const tab of document.querySelectorAll("nav button")) {
  tab.addEventListener("click", () => {
    for (const other of document.querySelectorAll("nav button")) {
      other.setAttribute("aria-selected", other === tab);
      part(other.dataset.panel).hidden = other !== tab;
    }
  });
}

// ---- The pixel under the pointer ----

let tracing = false;
let traceAgain = false;

const trace = async () => {
  if (part("pixel").hidden) return;
  traceAgain = true;
  if (tracing) return;
  tracing = true;
  while (traceAgain && !held) {
    traceAgain = false;
    try {
      listTrace(await order({ trace: pointer }));
    } catch (error) {
      part("pixel").replaceChildren(make("p", "hint", error.message));
    }
    await pause(80);
  }
  tracing = false;
};

const swatch = (row) => {
  const of = (name) => Number(row.find(([own]) => own === name)?.[1]);
  const colour = ["r", "g", "b"].map(of);
  if (colour.some(Number.isNaN)) return [];
  const byte = (linear) => 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
  const square = make("span", "swatch");
  square.style.background = `rgb(${colour.map((linear) => byte(Math.max(0, Math.min(1, linear))).toFixed(0)).join(" ")})`;
  return [square];
};

const listTrace = ({ pixel, columns }) => {
  const parts = [];
  let bounce = -1;
  for (const written of columns) {
    if (written.bounce !== bounce) {
      bounce = written.bounce;
      const head = bounce === 0 ? `Pixel ${pixel.join(", ")}` : `Bounce ${bounce}`;
      parts.push(make("h3", "", head), make("dl"));
    }
    const rows = written.rows.map((row) =>
      make("div", "row", ...row.map(([name, value]) => make("span", "", make("i", "", name), value)), ...(written.unit.includes("Rec. 709") ? swatch(row) : [])));
    const head = make("dt", "", written.column);
    head.title = written.stage;
    const place = make("small", "", `${written.space} · ${written.unit}`);
    parts.at(-1).append(head, make("dd", "", ...(rows.length ? rows : ["nothing"]), place));
  }
  part("pixel").replaceChildren(...parts);
};

// ---- The scene's text ----

const say = (sentence, bad) => {
  part("said").textContent = sentence;
  part("said").className = bad ? "bad" : "";
};

const setText = (text) => {
  part("text").value = text;
  listNumbers();
};

/** Sends the text; a mistake in it is shown, and the place of the mistake marked. */
const send = async (kind, done) => {
  const text = part("text").value;
  try {
    const answer = await order({ [kind]: text });
    if (sheet) sheet.text = text;
    say(done(answer));
    complain(null);
  } catch (error) {
    say(error.message, true);
    mark(text, error.message);
    return false;
  }
  await readSheet();
  return true;
};

const apply = () => send("apply", () => "Applied.");
const save = () => send("save", (file) => `Saved as ${file}.`);

/** Puts the camera into the text as it stands; the text is applied first, so that nothing typed is lost. */
const putView = async () => {
  if (!await apply()) return;
  try {
    await order("put_view");
    await readSheet();
    say("The camera is in the text.");
  } catch (error) {
    say(error.message, true);
  }
};

const mark = (text, sentence) => {
  const found = sentence.match(/:(\d+):(\d+):/);
  if (!found || document.activeElement?.closest("#numbers")) return;
  const lines = text.split("\n");
  const start = lines.slice(0, found[1] - 1).reduce((sum, line) => sum + line.length + 1, 0);
  const at = start + [...(lines[found[1] - 1] ?? "")].slice(0, found[2] - 1).join("").length;
  part("text").focus();
  part("text").setSelectionRange(at, start + (lines[found[1] - 1] ?? "").length);
  part("text").scrollTop = Math.max(0, (found[1] - 8) * 18);
};

part("apply").addEventListener("click", apply);
part("save").addEventListener("click", save);
part("view").addEventListener("click", putView);
part("text").addEventListener("input", () => listNumbers());

/** Where what begins at a place of the text ends: a string, a raw string or a comment; the place itself if none does. */
const after = (text, at) => {
  const found = (what, from) => {
    const place = text.indexOf(what, from);
    return place < 0 ? text.length : place + what.length;
  };
  const [letter, next] = [text[at], text[at + 1]];
  if (letter === '"') {
    let end = at + 1;
    while (end < text.length && text[end] !== '"') end += text[end] === "\\" ? 2 : 1;
    return Math.min(end + 1, text.length);
  }
  if (letter === "r" && (next === "#" || next === '"') && !/\w/.test(text[at - 1] ?? " ")) {
    let hashes = at + 1;
    while (text[hashes] === "#") hashes += 1;
    if (text[hashes] === '"') return found(`"${"#".repeat(hashes - at - 1)}`, hashes + 1);
  }
  if (letter === "/" && next === "/") return found("\n", at);
  if (letter !== "/" || next !== "*") return at;
  let [depth, end] = [1, at + 2];
  while (depth > 0 && end < text.length) {
    const two = text[end] + text[end + 1];
    depth += two === "/*" ? 1 : two === "*/" ? -1 : 0;
    end += two === "/*" || two === "*/" ? 2 : 1;
  }
  return end;
};

/** The entities of the text: where each begins and ends. Every letter is looked at once. */
const entities = (text) => {
  const found = [];
  let [depth, start, at] = [0, 0, 0];
  while (at < text.length) {
    const end = after(text, at);
    if (end > at) {
      at = end;
      continue;
    }
    if ("([{".includes(text[at])) {
      if (depth === 1) start = at;
      depth += 1;
    } else if (")]}".includes(text[at])) {
      depth -= 1;
      if (depth === 1) found.push([start, at + 1]);
    }
    at += 1;
  }
  return found;
};

const NUMBERS = {
  camera: /\b(fov|view_height|focus_distance|samples|radius|number|max_depth)\s*:\s*(-?[\d.]+(?:[eE][-+]?\d+)?)/g,
  light: /\b(width|depth|radius)\s*:\s*(-?[\d.]+(?:[eE][-+]?\d+)?)/g,
};

/** The numbers of the camera and of the lights that have a size: where each stands in the text, and what it is called. */
const numbers = (text) => entities(text).flatMap(([start, end]) => {
  const entity = text.slice(start, end);
  const kind = /\b\w+_camera\s*:/.test(entity) ? "camera" : /\bemissive\s*:/.test(entity) ? "light" : null;
  if (!kind) return [];
  const name = entity.match(/\bname\s*:\s*"([^"]*)"/)?.[1] ?? kind;
  const body = kind === "camera" ? entity.replace(/filter\s*:\s*\w+\([^)]*\)/, (filter) => " ".repeat(filter.length)) : entity;
  return [...body.matchAll(NUMBERS[kind])].map((match) => {
    const at = start + match.index + match[0].length - match[2].length;
    return { label: `${name}: ${match[1].replaceAll("_", " ")}`, at, length: match[2].length, value: Number(match[2]), whole: /samples|max_depth/.test(match[1]), most: match[1] === "fov" ? 170 : Infinity };
  });
});

const listNumbers = () => {
  if (document.activeElement?.closest("#numbers")) return;
  part("numbers").replaceChildren(...numbers(part("text").value).slice(0, 12).flatMap(slider));
};

const slider = ({ label, value, whole, most }, row) => {
  const [range, field] = ["range", "number"].map((type) => Object.assign(document.createElement("input"), { type }));
  const high = Math.min(most, Math.max(value * 4, whole ? 16 : 1e-3));
  Object.assign(range, { min: whole ? 1 : 0, max: high, step: whole ? 1 : "any" });
  Object.assign(field, { step: "any" });
  field.value = range.value = value;
  const named = make("label", "", label);
  named.title = label;
  for (const input of [range, field]) {
    input.setAttribute("aria-label", label);
    input.addEventListener("input", () => {
      if (input.value === "") return;
      const text = whole ? String(Math.round(input.value)) : decimal(Number(input.value));
      (input === range ? field : range).value = text;
      put(row, text);
    });
  }
  return [named, range, field];
};

/** A number as a scene file has it, with a point, so that it is no integer. */
const decimal = (value) => {
  const text = String(Number(value.toPrecision(6)));
  return /[.e]/.test(text) ? text : `${text}.0`;
};

let putting = false;
let putAgain = false;

/** Puts a number into the text and applies it, one text at a time. */
const put = async (row, number) => {
  const text = part("text");
  const found = numbers(text.value)[row];
  if (!found) return;
  text.setRangeText(number, found.at, found.at + found.length);
  putAgain = true;
  if (putting) return;
  putting = true;
  while (putAgain) {
    putAgain = false;
    await apply();
  }
  putting = false;
};

readSheet().catch(complain).then(follow);
