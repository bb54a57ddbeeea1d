// The scene's text, and the numbers of it that have a slider.
"use strict";

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
