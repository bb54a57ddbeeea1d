// What the mouse does: it moves the camera, magnifies the picture, and marks a part of it.
"use strict";

let moves = { orbit: [0, 0], pan: [0, 0], zoom: 1 };
let since = null;
let sending = false;

const still = () => ({ orbit: [0, 0], pan: [0, 0], zoom: 1 });
const isStill = ({ orbit, pan, zoom }) => !orbit[0] && !orbit[1] && !pan[0] && !pan[1] && zoom === 1;

/** The change that an order makes is awaited, to say how long it took. */
const wait = (change, since) => {
  awaited.push({ change, since });
  measure(Number(document.body.dataset.change ?? 0));
};

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
      wait(change, began);
    } catch (error) {
      complain(error);
      break;
    }
  }
  [sending, since] = [false, null];
};

const turn = (time, x, y) => {
  moves.orbit[0] += x;
  moves.orbit[1] += y;
  move(time);
};

const shift = (time, x, y) => {
  moves.pan[0] += x;
  moves.pan[1] += y;
  move(time);
};

const nearer = (time, factor) => {
  moves.zoom *= factor;
  move(time);
};

const place = (event) => {
  const { left, top, width, height } = picture.getBoundingClientRect();
  return [(event.clientX - left) / width, (event.clientY - top) / height];
};

// ---- The picture magnified, without the camera being moved ----

/** CSS pixels for one of the picture, none where it is made to fit; and where its middle is, from that of its frame. */
let zoom = { scale: null, x: 0, y: 0 };

const frameSize = () => [part("frame").clientWidth, part("frame").clientHeight];

/** The scale at which the whole picture is seen. */
const fitting = () => {
  const [wide, high] = frameSize();
  const narrow = matchMedia("(max-width: 900px)").matches;
  return Math.min(wide / sheet.size[0], narrow ? Infinity : high / sheet.size[1]);
};

/** The picture fills its place without changing its proportions, or is magnified. */
const fit = () => {
  if (!sheet) return;
  const [width, height] = sheet.size;
  const scale = zoom.scale ?? fitting();
  const style = part("paper").style;
  part("frame").style.setProperty("--fitting", `${Math.floor(height * fitting())}px`);
  const [wide, high] = frameSize();
  const [w, h] = [width * scale, height * scale].map((side) => (zoom.scale ? side : Math.floor(side)));
  [style.width, style.height] = [`${w}px`, `${h}px`];
  style.transform = `translate(${Math.round((wide - w) / 2 + zoom.x)}px, ${Math.round((high - h) / 2 + zoom.y)}px)`;
  const coarse = picture.width < width;
  picture.style.imageRendering = !coarse && scale * (devicePixelRatio || 1) >= 2 ? "pixelated" : "auto";
  part("scale").textContent = zoom.scale ? `${(100 * scale * devicePixelRatio).toFixed(0)} %` : "fit";
  document.body.dataset.scale = scale.toFixed(4);
};

new ResizeObserver(() => requestAnimationFrame(fit)).observe(part("frame"));

/** Magnifies about a point of the picture, which stays where it is; never smaller than it fits. */
const magnify = (factor, [x, y] = pointer) => {
  if (!sheet) return;
  const least = fitting();
  const from = zoom.scale ?? least;
  const to = Math.min(from * factor, 128);
  if (to <= least) {
    zoom = { scale: null, x: 0, y: 0 };
  } else {
    const [width, height] = sheet.size;
    zoom = { scale: to, x: zoom.x - (x - 0.5) * width * (to - from), y: zoom.y - (y - 0.5) * height * (to - from) };
  }
  fit();
};

/** One pixel of the picture on one of the screen, or the whole picture again. */
const oneToOne = () => {
  const one = 1 / (devicePixelRatio || 1);
  const [width, height] = sheet.size;
  const middle = ([x, y]) => ({ scale: one, x: (0.5 - x) * width * one, y: (0.5 - y) * height * one });
  zoom = zoom.scale === one ? { scale: null, x: 0, y: 0 } : middle(pointer);
  fit();
};

const slide = (x, y) => {
  if (!zoom.scale) return;
  zoom = { ...zoom, x: zoom.x + x, y: zoom.y + y };
  fit();
};

// ---- A part of the picture ----

const within = (number) => Math.min(1, Math.max(0, number));

/** The part between two points; none where they are too near. */
const between = ([x, y], [u, v]) => {
  const sides = [Math.min(x, u), Math.min(y, v), Math.max(x, u), Math.max(y, v)].map(within);
  return (sides[2] - sides[0]) * sheet.size[0] >= 1 && (sides[3] - sides[1]) * sheet.size[1] >= 1 ? sides : null;
};

const drawRegion = (sides) => {
  const mark = part("region");
  mark.hidden = !sides;
  if (!sides) return;
  const [left, top, right, bottom] = sides.map((side) => `${(100 * side).toFixed(3)}%`);
  [mark.style.left, mark.style.top] = [left, top];
  [mark.style.width, mark.style.height] = [`calc(${right} - ${left})`, `calc(${bottom} - ${top})`];
};

let corner = null;

/** By keys: one corner, the other, and everywhere again. */
const markCorner = () => {
  if (sheet.region) return choose({ region: null });
  if (!corner) {
    corner = [...pointer];
    return drawRegion([...corner.map((at) => within(at - 0.003)), ...corner.map((at) => within(at + 0.003))]);
  }
  const sides = between(corner, pointer);
  corner = null;
  drawRegion(sides);
  if (sides) choose({ region: sides });
};

// ---- The mouse ----

let held = null;
let pointer = [0.5, 0.5];

picture.addEventListener("pointerdown", (event) => {
  picture.setPointerCapture(event.pointerId);
  picture.classList.add("held");
  picture.focus();
  const kind = event.button === 1 || event.altKey ? "slide" : event.ctrlKey || event.metaKey ? "region" : event.button === 2 || event.shiftKey ? "pan" : "orbit";
  held = { x: event.clientX, y: event.clientY, kind, from: place(event), moved: false };
  event.preventDefault();
});

picture.addEventListener("pointermove", (event) => {
  pointer = place(event);
  drawPointer(false);
  if (!held) return trace();
  const [x, y] = [event.clientX - held.x, event.clientY - held.y];
  const height = picture.getBoundingClientRect().height;
  held.moved ||= x !== 0 || y !== 0;
  if (held.kind === "slide") slide(x, y);
  else if (held.kind === "region") drawRegion(between(held.from, pointer));
  else if (held.kind === "pan") shift(event.timeStamp, x / height, y / height);
  else turn(event.timeStamp, x / height, y / height);
  [held.x, held.y] = [event.clientX, event.clientY];
});

for (const end of ["pointerup", "pointercancel"]) {
  picture.addEventListener(end, (event) => {
    if (held?.kind === "region" && end === "pointerup") choose({ region: held.moved ? between(held.from, place(event)) : null });
    held = null;
    picture.classList.remove("held");
  });
}
picture.addEventListener("contextmenu", (event) => event.preventDefault());
picture.addEventListener("wheel", (event) => {
  event.preventDefault();
  const lines = event.deltaMode === 1 ? 16 : 1;
  const by = Math.exp(Math.max(-200, Math.min(200, event.deltaY * lines)) * 0.0015);
  if (event.ctrlKey || event.metaKey || event.altKey) magnify(1 / by ** 2, place(event));
  else nearer(event.timeStamp, by);
}, { passive: false });

const focusOn = () => order({ focus: pointer }).then(() => complain(null), complain);
picture.addEventListener("dblclick", focusOn);

// ---- The page filled ----

/** Renders as many pixels as there is room for, whatever proportions the scene has. */
const room = () => frameSize().map((side) => Math.max(1, Math.round(side * (devicePixelRatio || 1))));
const fill = () => choose({ size: sheet.fills ? null : room() });

let resizing = 0;
addEventListener("resize", () => {
  fit();
  clearTimeout(resizing);
  if (sheet?.fills) resizing = setTimeout(() => choose({ size: room() }), 300);
});

/** All of the page, the picture with what belongs to it, or the picture alone. */
const nextPanels = () => {
  document.body.dataset.panels = (Number(document.body.dataset.panels ?? 0) + 1) % 3;
  fit();
  if (sheet?.fills) choose({ size: room() });
};
