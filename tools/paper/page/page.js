"use strict";
// Shows the computed point under the pointer, as text and as a ring in every picture of it.
// tools/paper/packed_spectrum.py describes the format of the data of a spectrum.

const constants = JSON.parse(document.getElementById("constants").textContent);
const hint = "Move over the spectrum, tap it, or use the arrow keys.";
const arrows = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowDown: [-1, 0], ArrowUp: [1, 0] };

function valueOf(code) {
  if (code === constants.unknown) return NaN;
  if (code === 0) return 0;
  const size = Math.abs(code) - 1;
  const digits = size % constants.steps + 100;
  const exponent = Math.floor(size / constants.steps) + constants.leastExponent - 2;
  return Math.sign(code) * Number(`${digits}e${exponent}`);
}

async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

function codesOf(low, high, columns) {
  const codes = new Int16Array(low.length);  // wraps around, as intended
  for (let i = 0; i < codes.length; ++i) {
    codes[i] = (i % columns ? codes[i - 1] : 0) + (high[i] << 8 | low[i]);
  }
  return codes;
}

class Spectrum {
  constructor(buffer, rows, columns) {
    Object.assign(this, { rows, columns });
    this.frequency = new Float64Array(buffer, 0, columns);
    this.amplitude = new Float64Array(buffer, 8 * columns, rows);
    let begin = 8 * (rows + columns);
    const plane = () => {
      const bytes = new Uint8Array(buffer, begin, rows * columns);
      begin += rows * columns;
      return bytes;
    };
    this.codes = {};
    for (const field of constants.fields) this.codes[field] = codesOf(plane(), plane(), columns);
    this.region = plane();
  }

  point(row, column) {
    const at = row * this.columns + column;
    const point = { row, column, frequency: this.frequency[column], amplitude: this.amplitude[row],
                    region: this.region[at] };
    for (const field of constants.fields) point[field] = valueOf(this.codes[field][at]);
    return point;
  }
}

const spectra = new Map();

// Unpacked on first use.
function spectrumOf(picture) {
  const name = picture.dataset.spectrum;
  if (!spectra.has(name)) {
    const data = document.getElementById(`data_${name}`);
    spectra.set(name, inflated(data.textContent).then((buffer) =>
      new Spectrum(buffer, Number(data.dataset.rows), Number(data.dataset.columns))));
  }
  return spectra.get(name);
}

// The position of a value along an axis, from 0 to 1.
function share(axis, value) {
  const shown = axis.scale === "log" ? Math.log : Number;
  const [first, last] = axis.limits.map(shown);
  return (shown(value) - first) / (last - first);
}

function nearest(values, axis, wanted) {
  let best = 0;
  values.forEach((value, i) => {
    const distance = (other) => Math.abs(share(axis, other) - wanted);
    if (distance(value) < distance(values[best])) best = i;
  });
  return best;
}

// The computed point nearest to a position on the screen, or null outside of the axes.
function pointAt(picture, spectrum, event) {
  const box = picture.getBoundingClientRect();
  const x = (event.clientX - box.left) / box.width;
  const y = (event.clientY - box.top) / box.height;
  const panel = picture.places.find((place) => place.shows === "plane");
  const across = (x - panel.left) / (panel.right - panel.left);
  const up = (panel.bottom - y) / (panel.bottom - panel.top);
  if (Math.min(across, up) < 0 || Math.max(across, up) > 1) return null;
  return spectrum.point(nearest(spectrum.amplitude, panel.up, up),
                        nearest(spectrum.frequency, panel.across, across));
}

function rounded(value, digits) {
  return Number.isNaN(value) ? "not known" : value.toPrecision(digits).replace("-", "−");
}

function element(kind, name, ...content) {
  const made = document.createElement(kind);
  made.className = name;
  made.append(...content);
  return made;
}

// The space at the end separates it from the next number in screen readers.
function number(name, text) {
  return element("span", "number", element("i", "", name), ` = ${text} `);
}

function endOf(point) {
  if (point.region > constants.leftStanding && constants.regions[point.region][0]) {
    const side = point.angle > 0 ? "π/2" : "−π/2";
    return [element("span", "end", `overturned during the pulse, passing θ = ${side} with `),
            number("θ′", `${rounded(point.velocity, 3)} rad`)];
  }
  return [number("θ", `${rounded(point.angle, 3)} rad`),
          number("θ′", `${rounded(point.velocity, 3)} rad`)];
}

function fill(readout, point) {
  readout.classList.toggle("filled", Boolean(point));
  if (!point) {
    readout.replaceChildren(element("span", "hint", hint));
    return;
  }
  const [name, meaning, colour] = constants.regions[point.region];
  const swatch = element("i", "swatch");
  swatch.style.background = colour;
  readout.replaceChildren(
    element("span", "region", swatch, element("b", "", name), ` ${meaning} `),
    number("Ω", rounded(point.frequency, 5)), number("a", rounded(point.amplitude, 5)),
    number("margin", rounded(point.margin, 3)), ...endOf(point));
}

// The position of a point in a panel; NaN in phase space if the block overturned during the pulse.
function sharesIn(place, point) {
  if (place.shows === "plane") {
    return [share(place.across, point.frequency), share(place.up, point.amplitude)];
  }
  if (point.region > constants.leftStanding) return [NaN, NaN];
  return [share(place.across, point.angle), share(place.up, point.velocity)];
}

function mark(picture, point) {
  picture.querySelectorAll(".mark").forEach((ring) => ring.remove());
  for (const place of point ? picture.places : []) {
    const [across, up] = sharesIn(place, point);
    if (!(Math.min(across, up) >= 0 && Math.max(across, up) <= 1)) continue;
    const ring = element("div", "mark");
    ring.style.left = `${100 * (place.left + across * (place.right - place.left))}%`;
    ring.style.top = `${100 * (place.bottom + up * (place.top - place.bottom))}%`;
    picture.append(ring);
  }
}

const pictures = [...document.querySelectorAll(".picture[data-spectrum]")];
const kept = new Map();  // by spectrum: the point selected by click or keys
const shown = new Map();

function show(picture, point) {
  shown.set(picture.dataset.spectrum, point);
  for (const other of pictures) {
    if (other.dataset.spectrum !== picture.dataset.spectrum) continue;
    mark(other, point);
    readoutOf(other).setAttribute("aria-live", other === picture ? "polite" : "off");
    fill(readoutOf(other), point);
  }
}

function readoutOf(picture) {
  return picture.closest("figure").querySelector(".readout");
}

function keep(picture, point) {
  kept.set(picture.dataset.spectrum, point);
  show(picture, point);
}

function walk(spectrum, from, [rows, columns], steps) {
  const within = (index, count) => Math.min(Math.max(index, 0), count - 1);
  if (!from) return spectrum.point(spectrum.rows >> 1, spectrum.columns >> 1);
  return spectrum.point(within(from.row + steps * rows, spectrum.rows),
                        within(from.column + steps * columns, spectrum.columns));
}

for (const picture of pictures) {
  picture.places = JSON.parse(picture.dataset.places);
  const name = picture.dataset.spectrum;
  let latest = null;
  // Handles events in order, although the first one waits for the spectrum.
  const answer = (event, action) => {
    latest = event;
    spectrumOf(picture).then((spectrum) => {
      if (latest === event) action(spectrum);
    }).catch((error) => {
      readoutOf(picture).textContent = `Cannot read the values: ${error}`;
    });
  };
  fill(readoutOf(picture), null);
  picture.addEventListener("pointermove", (event) => answer(event, (spectrum) =>
    show(picture, pointAt(picture, spectrum, event) || kept.get(name) || null)));
  picture.addEventListener("pointerleave", (event) => answer(event, () =>
    show(picture, kept.get(name) || null)));
  picture.addEventListener("click", (event) => answer(event, (spectrum) =>
    keep(picture, pointAt(picture, spectrum, event))));
  picture.addEventListener("keydown", (event) => {
    if (event.key === "Escape") answer(event, () => keep(picture, null));
    if (!(event.key in arrows)) return;
    event.preventDefault();  // prevent scrolling
    spectrumOf(picture).then((spectrum) => keep(picture,
      walk(spectrum, shown.get(name), arrows[event.key], event.shiftKey ? 10 : 1)));
  });
}
