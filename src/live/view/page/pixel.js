// The pixel under the pointer: what every stage wrote for it, and what the film has gathered; and pixels that are pinned.
"use strict";

let tracing = false;
let traceAgain = false;

const trace = async () => {
  traceAgain = true;
  if (tracing) return;
  tracing = true;
  while (traceAgain && !held) {
    traceAgain = false;
    try {
      const traced = await order({ trace: pointer });
      listTrace(traced);
      readings[0] = traced.reading;
      listReadings();
    } catch (error) {
      part("pixel").replaceChildren(make("p", "hint", error.message));
    }
    await pause(80);
  }
  tracing = false;
};

/** By keys: the pixels beside the one that is looked at. */
const stepPixel = (x, y) => {
  const [width, height] = sheet.size;
  const at = (part, pixels, by) => within((Math.min(pixels - 1, Math.max(0, Math.floor(part * pixels) + by)) + 0.5) / pixels);
  pointer = [at(pointer[0], width, x), at(pointer[1], height, y)];
  drawPointer(true);
  trace();
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
  if (part("pixel").hidden) return;
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

// ---- What the film has gathered ----

/** That of the pixel under the pointer, and those of the pinned ones. */
let readings = [null];
let pins = [];
let hits = [];

const MOST_PINS = 2;

const putAt = ([x, y], mark) => {
  [mark.style.left, mark.style.top] = [`${(100 * x).toFixed(4)}%`, `${(100 * y).toFixed(4)}%`];
  return mark;
};

const drawPins = () => part("pins").replaceChildren(...pins.map((at, number) => putAt(at, make("span", "pin", "AB"[number]))));
const drawPointer = (shown) => {
  part("pointer").hidden = !shown;
  putAt(pointer, part("pointer"));
};

/** Pins the pixel under the pointer; the third in place of the second. */
const pin = () => {
  const at = pointer.map((part, side) => (Math.min(sheet.size[side] - 1, Math.max(0, Math.floor(part * sheet.size[side]))) + 0.5) / sheet.size[side]);
  return setPins([...pins.slice(0, MOST_PINS - 1), at]);
};

const setPins = async (wanted) => {
  pins = wanted;
  drawPins();
  try {
    const answer = await order({ pin: pins });
    hits = answer.map(({ entity }) => entity);
    readings = [readings[0], ...answer.map(({ reading }) => reading)];
    listReadings();
  } catch (error) {
    complain(error);
  }
};

/** A number with its standard error, of which two digits say enough. */
const sure = (value, error) => {
  if (error === null || error === undefined || value === null) return short(value);
  const places = error > 0 ? Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(error)))) : 4;
  return places > 8 ? `${value.toExponential(3)} ± ${error.toExponential(1)}` : `${value.toFixed(places)} ± ${error.toFixed(places)}`;
};

/** The difference of two independent means, and their ratio to first order. */
const apart = (b, a, eb, ea) => [b - a, eb === null || ea === null ? null : Math.hypot(ea, eb)];
const ratio = (b, a, eb, ea) => [a === 0 ? null : b / a, eb === null || ea === null || a === 0 ? null : Math.abs(b / a) * Math.hypot(b === 0 ? 0 : eb / b, ea / a)];

/** The numbers of a reading with their standard errors: those of false colour, or of the light. */
const parts = (reading) => {
  const { column, component } = painted();
  if (column) return component ? [[reading.number, null]] : reading.mean.map((part) => [part, null]);
  const [light, sure] = reading.luminance;
  const list = [...reading.mean.map((part, at) => [part, reading.error?.[at] ?? null]), [light, sure]];
  if (component && !["red", "green", "blue", "luminance"].includes(component)) list.push([reading.number, null]);
  return list;
};

const listReadings = () => {
  if (!sheet) return;
  const { column, component } = painted();
  const light = ["red", "green", "blue", "luminance"];
  const names = column ? (component ? [component] : ["red", "green", "blue"]) : component && !light.includes(component) ? [...light, component] : light;
  const head = make("tr", "", ...["", "pixel", "samples", ...names, "hit"].map((name) => make("th", name === "" || name === "pixel" || name === "hit" ? "" : "number", name)));
  const row = (name, reading, entity) => make("tr", "", make("th", "", name),
    make("td", "", reading ? reading.pixel.join(", ") : ""), make("td", "number", reading ? String(reading.samples) : ""),
    ...(reading ? parts(reading) : names.map(() => null)).map((own) => make("td", "number", own ? sure(...own) : "")),
    make("td", "", entity ?? ""));
  const rows = [row("pointer", readings[0], ""), ...pins.map((_, number) => row("AB"[number], readings[number + 1], hits[number] ?? "nothing"))];
  if (readings[0]?.reference) {
    const own = light.map((name, at) => (at < 3 ? readings[0].reference[at] : luminance(readings[0].reference)));
    rows.splice(1, 0, make("tr", "", make("th", "", "its reference"), make("td", ""), make("td", ""), ...own.map((value) => make("td", "number", short(value)))));
  }
  const [a, b] = readings.slice(1);
  if (a && b) {
    const withBoth = (by) => parts(b).map(([value, error], at) => by(value, parts(a)[at][0], error, parts(a)[at][1]));
    const both = (name, list) => make("tr", "", make("th", "", name), make("td", ""), make("td", ""), ...list.map((own) => make("td", "number", sure(...own))), make("td", ""));
    rows.push(both("B − A", withBoth(apart)), both("B / A", withBoth(ratio)));
  }
  part("readings").replaceChildren(head, ...rows);
};

const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** With every frame. */
const showReadings = (list) => {
  readings = [list[0] ?? readings[0], ...list.slice(1)];
  listReadings();
};
