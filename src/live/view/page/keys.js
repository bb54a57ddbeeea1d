// Keys and buttons, the address, kept views; and the beginning of it all.
"use strict";

// ---- The address: what of the page it carries is seen again at another time, or by someone else ----

const digits = (numbers) => numbers.map((number) => Number(number.toPrecision(9))).join(",");

/** The address as the page last wrote or followed it; another one is the reader's, and is followed before it is written over. */
let address = null;

const keepAddress = () => {
  if (!sheet || location.hash !== address) return;
  const kept = new URLSearchParams();
  if (sheet.mode !== sheet.modes[0][0]) kept.set("mode", sheet.mode);
  if (sheet.column) kept.set("show", sheet.column);
  if (look.exposure) kept.set("exposure", look.exposure);
  if (look.automatic) kept.set("auto", 1);
  if (look.curve !== "scene") kept.set("curve", look.curve);
  if (look.range) kept.set("range", digits(look.range));
  if (sheet.camera) {
    for (const name of ["eye", "target", "up"]) kept.set(name, digits(sheet.camera[name]));
    kept.set("height", digits([sheet.camera.height]));
  }
  const next = kept.size ? `#${kept.toString().replaceAll("%2C", ",")}` : location.pathname;
  if (next !== (location.hash || location.pathname)) history.replaceState(null, "", next);
  address = location.hash;
};

/** Does what the address says, as far as it is not so already; what it cannot say is told. */
const followAddress = async () => {
  address = location.hash;
  const wanted = new URLSearchParams(location.hash.slice(1));
  const numbers = (name) => wanted.get(name).split(",").map(Number);
  const orders = [];
  if (wanted.has("mode") && wanted.get("mode") !== sheet.mode) orders.push({ mode: wanted.get("mode") });
  if (wanted.has("show") && wanted.get("show") !== sheet.column) orders.push({ column: wanted.get("show") });
  const change = {};
  if (wanted.has("exposure")) change.exposure = Number(wanted.get("exposure"));
  if (wanted.has("auto")) change.automatic = true;
  if (wanted.has("curve")) change.curve = wanted.get("curve");
  if (wanted.has("range")) change.range = numbers("range");
  const next = { ...sheet.look, ...change };
  if (JSON.stringify(next) !== JSON.stringify(sheet.look)) orders.push({ look: next });
  if (wanted.has("eye")) {
    const camera = { eye: numbers("eye"), target: wanted.has("target") ? numbers("target") : null, up: wanted.has("up") ? numbers("up") : [0, 1, 0], height: wanted.has("height") ? Number(wanted.get("height")) : 1 };
    const own = sheet.camera && digits([...sheet.camera.eye, ...sheet.camera.target]);
    if (own !== digits([...camera.eye, ...(camera.target ?? [])])) orders.push({ camera });
  }
  if (!orders.length) return keepAddress();
  let mistake = null;
  [choices, unanswered] = [choices + 1, unanswered + 1];
  for (const what of orders) {
    try {
      await order(what);
    } catch (error) {
      mistake ??= `The address has ${decodeURIComponent(address)}: ${error.message}`;
    }
  }
  unanswered -= 1;
  await readSheet();
  if (mistake) complain(mistake);
};
addEventListener("hashchange", followAddress);

// ---- Kept views ----

const views = new Map();
let keepsView = false;

const keepOrShow = (number, keep) => {
  if (keep) {
    views.set(number, sheet.camera);
    part("latency").textContent = `view ${number} kept`;
  } else if (views.has(number)) {
    choose(views.get(number) ? { camera: views.get(number) } : "reset");
  }
};

// ---- Keys ----

const pauseOrGoOn = () => choose({ pause: !sheet.paused });
const undo = () => {
  document.activeElement?.blur?.();
  return choose("undo");
};
const redo = () => {
  document.activeElement?.blur?.();
  return choose("redo");
};

const keys = {
  "0": () => choose("reset"),
  "+": (time) => nearer(time, 0.9),
  "=": (time) => nearer(time, 0.9),
  "-": (time) => nearer(time, 1 / 0.9),
  "f": focusOn,
  "v": () => putView(),
  "?": () => part("keys").showModal(),
  "e": () => expose(0.5),
  "E": () => expose(-0.5),
  "o": () => setLook({ automatic: !look.automatic }),
  "t": nextCurve,
  "c": nextComponent,
  "]": () => nextColumn(1),
  "[": () => nextColumn(-1),
  "g": automatic,
  "q": () => choose({ reference: true }),
  "Q": () => choose({ reference: false }),
  "a": () => compare("reference"),
  "d": () => compare("difference"),
  "p": pin,
  "P": () => setPins([]),
  "i": () => stepPixel(0, -1),
  "I": () => stepPixel(0, -10),
  "k": () => stepPixel(0, 1),
  "K": () => stepPixel(0, 10),
  "j": () => stepPixel(-1, 0),
  "J": () => stepPixel(-10, 0),
  "l": () => stepPixel(1, 0),
  "L": () => stepPixel(10, 0),
  "z": () => magnify(1.5),
  "Z": () => magnify(1 / 1.5),
  "x": oneToOne,
  "w": fill,
  "n": nextPanels,
  "r": markCorner,
  " ": pauseOrGoOn,
  "b": () => { keepsView = true; },
};

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

const arrow = (event, [x, y]) => {
  event.preventDefault();
  if (event.ctrlKey || event.metaKey) slide(-40 * x, -40 * y);
  else if (event.shiftKey) shift(event.timeStamp, 0.04 * x, 0.04 * y);
  else turn(event.timeStamp, 0.03 * x, 0.03 * y);
};

document.addEventListener("keydown", (event) => {
  const types = event.target.matches("textarea, input:not([type=range], [type=checkbox])");
  const typing = types || event.target.matches("input, select");
  const command = event.ctrlKey || event.metaKey;
  const key = event.key.toLowerCase();
  if (command && key === "s") {
    event.preventDefault();
    return save();
  }
  if (command && event.key === "Enter") return apply();
  if (command && !types && (key === "z" || key === "y")) {
    event.preventDefault();
    return key === "y" || event.shiftKey ? redo() : undo();
  }
  if (part("keys").open || !sheet) return;
  const scrolls = document.documentElement.scrollHeight > innerHeight || event.target.matches(".panel, .panel *, nav *");
  if (ARROWS[event.key] && !typing && !event.altKey && (event.target === picture || !scrolls)) return arrow(event, ARROWS[event.key]);
  if (typing || command || event.altKey) return;
  const digit = /^Digit([1-9])$/.exec(event.code)?.[1];
  if (digit && (keepsView || event.shiftKey)) {
    keepOrShow(digit, keepsView);
    keepsView = false;
    return;
  }
  if (event.key !== "Shift") keepsView = false;
  const mode = sheet.modes.find(([own]) => own === event.key);
  if (mode) return choose({ mode: mode[0] });
  if (event.key === " " && event.target.matches("button, summary, a")) return;
  const done = keys[event.key] ?? keys[key];
  if (done) {
    event.preventDefault();
    done(event.timeStamp);
  }
});

for (const [id, done] of [["help", keys["?"]], ["pause", pauseOrGoOn], ["undo", undo], ["redo", redo], ["fill", fill],
  ["scale", oneToOne], ["larger", () => magnify(1.5, [0.5, 0.5])], ["smaller", () => magnify(1 / 1.5, [0.5, 0.5])],
  ["pin", pin], ["unpin", () => setPins([])], ["panels", nextPanels]]) {
  part(id).addEventListener("click", done);
}

drawColours().catch(complain);
readSheet().then(followAddress).catch(complain).then(follow);
