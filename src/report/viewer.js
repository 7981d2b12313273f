// Two layers of a frame, left and right of a line. All values are in the page; light becomes a picture here, so that
// exposure and tone are the reader's. viewer.cpp writes what is read here: #viewer-frame and #viewer-layer-N.
'use strict';

const element = name => document.getElementById('viewer-' + name);
const frame = JSON.parse(element('frame').textContent);
const pixels = frame.width * frame.height;
const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

// ---- values ------------------------------------------------------------------------------------------------------------

// Base64 of a zlib stream; in it, channel by channel, the highest bytes of all pixels, then the next ones.
async function decode(number, channels) {
  const packed = (await fetch('data:;base64,' + element('layer-' + number).textContent)).body;
  const bytes = new Uint8Array(await new Response(packed.pipeThrough(new DecompressionStream('deflate'))).arrayBuffer());
  const planes = [];
  for (let channel = 0; channel < channels; ++channel) {
    const words = new Uint32Array(pixels);
    for (let byte = 0; byte < 4; ++byte) {
      const begin = (4 * channel + byte) * pixels;
      for (let p = 0; p < pixels; ++p) words[p] |= bytes[begin + p] << (24 - 8 * byte);
    }
    planes.push(new Float32Array(words.buffer));
  }
  return planes;
}

// ---- values to colors --------------------------------------------------------------------------------------------------

// What becomes of light before a display clamps it to 0 .. 1. ACES: the curve of HDR-FLIP (docs/commands.md).
const tones = {
  'sRGB': v => v,
  'ACES': v => v <= 0 ? 0 : (0.9036 * v + 0.018) * v / ((0.8748 * v + 0.354) * v + 0.14),
  'Reinhard': v => v <= 0 ? 0 : v / (1 + v),
};

// The bytes of linear light from 0 to 1 (IEC 61966-2-1), so close together that neighbors differ by a tenth of a byte at most.
const displayed = Uint8Array.from({length: 1 << 16}, (_, i) => {
  const light = i / 65535;
  return Math.round(255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055));
});
const encoded = light => light > 0 ? displayed[Math.min(light, 1) * 65535 + 0.5 | 0] : 0;

// Each paints pixel p into the bytes of an image. What is no number is magenta.
function lightPainter([red, green, blue]) {
  const gain = 2 ** view.exposure, tone = tones[view.tone];
  const shown = light => encoded(light === Infinity ? 1 : tone(light * gain));
  return (image, p) => {
    const isNumber = !Number.isNaN(red[p]) && !Number.isNaN(green[p]) && !Number.isNaN(blue[p]);
    image[4 * p] = isNumber ? shown(red[p]) : 255;
    image[4 * p + 1] = isNumber ? shown(green[p]) : 0;
    image[4 * p + 2] = isNumber ? shown(blue[p]) : 255;
  };
}

function errorPainter([errors]) {
  const decades = Math.log(frame.brightest / frame.darkest);
  return (image, p) => {
    const position = Math.log(errors[p] / frame.darkest) / decades;
    const color = frame.magma[Math.round(255 * (position < 1 ? Math.max(position, 0) : 1))];  // NaN: the brightest
    image[4 * p] = color >> 16;
    image[4 * p + 1] = color >> 8 & 255;
    image[4 * p + 2] = color & 255;
  };
}

function colorPainter(planes) {
  return (image, p) => {
    for (let channel = 0; channel < 3; ++channel) image[4 * p + channel] = encoded(planes[channel][p]);
  };
}

const painters = {light: lightPainter, error: errorPainter, color: colorPainter};

function draw(layer) {
  const image = new ImageData(frame.width, frame.height), paint = painters[layer.kind](layer.planes);
  for (let p = 0; p < pixels; ++p) {
    paint(image.data, p);
    image.data[4 * p + 3] = 255;
  }
  layer.canvas.getContext('2d').putImageData(image, 0, 0);
}

// The layer's picture at this exposure and tone; drawn when one of them has changed.
function picture(layer) {
  const state = layer.kind === 'light' ? view.exposure + view.tone : 'fixed';
  if (layer.state !== state) draw(layer);
  layer.state = state;
  return layer.canvas;
}

// ---- the stage ---------------------------------------------------------------------------------------------------------

const stage = element('stage'), canvas = element('canvas');
const largestScale = 64;  // CSS pixels a pixel
const view = {
  left: frame.left, right: frame.right,  // numbers of layers
  split: 0.5,                            // of the stage's width
  exposure: 0, tone: 'sRGB',             // stops
  scale: 0,                              // CSS pixels a pixel; 0: as much as fits
  x: frame.width / 2, y: frame.height / 2,                          // in the middle of the stage
  pixel: [frame.width >> 1, frame.height >> 1],                     // whose values are told
};
let layers = [];

const fittingScale = () => Math.min(stage.clientWidth / frame.width, stage.clientHeight / frame.height);
const scale = () => view.scale || fittingScale();

// As wide as the page, as high as the frame then is, but never higher than most of the window.
function resize() {
  stage.style.height = Math.min(stage.clientWidth * frame.height / frame.width, 0.8 * window.innerHeight) + 'px';
  update();
}

function keepInside() {
  if (view.scale <= fittingScale()) view.scale = 0;
  for (const [axis, length, room] of [['x', frame.width, stage.clientWidth], ['y', frame.height, stage.clientHeight]]) {
    const half = Math.min(room / scale(), length) / 2;
    view[axis] = clamp(view[axis], half, length - half);
  }
}

function drawStage() {
  const density = window.devicePixelRatio || 1;
  canvas.width = Math.round(stage.clientWidth * density);
  canvas.height = Math.round(stage.clientHeight * density);
  const context = canvas.getContext('2d'), s = scale() * density;
  const line = Math.round(view.split * canvas.width);
  const sides = [[layers[view.left], 0, line], [layers[view.right], line, canvas.width - line]];
  for (const [layer, begin, width] of sides) {
    context.save();
    context.beginPath();
    context.rect(begin, 0, width, canvas.height);
    context.clip();
    context.imageSmoothingEnabled = s < 1;
    context.translate(canvas.width / 2, canvas.height / 2);
    context.scale(s, s);
    context.drawImage(picture(layer), -view.x, -view.y);
    context.restore();
  }
  if (scale() >= 4) outlinePixel(context, s);
}

function outlinePixel(context, s) {
  const left = canvas.width / 2 + (view.pixel[0] - view.x) * s, top = canvas.height / 2 + (view.pixel[1] - view.y) * s;
  for (const [color, out] of [['#000000', 1.5], ['#ffffff', 0.5]]) {
    context.strokeStyle = color;
    context.strokeRect(left - out, top - out, s + 2 * out, s + 2 * out);
  }
}

// ---- the numbers -------------------------------------------------------------------------------------------------------

// Digits that mean something, and no more of them than the value needs.
const told = (value, digits) => Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : String(value);

function cellsOf(layer, p) {
  const values = layer.planes.map(plane => plane[p]);
  if (layer.kind !== 'color') return values.map(value => told(value, layer.digits));
  const parts = values.slice(3).map((value, i) => layer.channels[i + 3] + ' ' + Math.round(100 * value) + ' %');
  return [values.slice(3).some(value => value > 0) ? parts.join(', ') : 'none'];
}

function row(cells, kind) {
  const tr = document.createElement('tr');
  cells.forEach((text, i) => {
    const cell = document.createElement(i === 0 ? 'th' : kind);
    cell.textContent = text;
    if (i === 1 && cells.length === 2) Object.assign(cell, {colSpan: 3, className: 'whole'});
    tr.append(cell);
  });
  return tr;
}

function tell() {
  const [x, y] = view.pixel;
  element('pixel').textContent = `Pixel ${frame.x + x}, ${frame.y + y}`;
  const rows = layers.map(layer => row([layer.name, ...cellsOf(layer, y * frame.width + x)], 'td'));
  element('values').replaceChildren(row(['', 'R', 'G', 'B'], 'th'), ...rows);
}

function tellState() {
  const stops = view.exposure;
  element('exposure').value = stops;
  element('exposure-text').textContent = (stops < 0 ? '−' : '+') + Math.abs(stops).toFixed(2) + ' stops';
  element('zoom-text').textContent = Math.round(100 * scale()) + ' %';
  element('split').value = Math.round(1000 * view.split);
  element('divider').style.left = 100 * view.split + '%';
  for (const side of ['left', 'right']) {
    element(side).value = view[side];
    element(side + '-tag').textContent = layers[view[side]].name;
  }
  stage.classList.toggle('zoomed', view.scale > 0);
  const exposed = [view.left, view.right].some(number => layers[number].kind === 'light');
  element('exposure').disabled = element('tone').disabled = !exposed;
  layers.forEach((layer, i) => {
    const shown = layer.kind !== 'light' && (i === view.left || i === view.right);
    element('legend-' + i).hidden = !shown;
  });
}

let waiting = false;
// Once a frame, however many events there are.
function update() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    keepInside();
    drawStage();
    tellState();
    tell();
  });
}

// ---- what the reader does ----------------------------------------------------------------------------------------------

// Zooms so that the place in the picture that is at a point of the stage stays there.
function zoom(factor, [px, py]) {
  const before = scale(), after = clamp(before * factor, fittingScale(), Math.max(largestScale, fittingScale()));
  const offX = px - stage.clientWidth / 2, offY = py - stage.clientHeight / 2;
  view.x += offX / before - offX / after;
  view.y += offY / before - offY / after;
  view.scale = after;
  update();
}

// Where the middle of the pixel that is told stands on the stage.
const placeOfPixel = () => [stage.clientWidth / 2 + (view.pixel[0] + 0.5 - view.x) * scale(),
                            stage.clientHeight / 2 + (view.pixel[1] + 0.5 - view.y) * scale()];
const zoomOnPixel = factor => zoom(factor, placeOfPixel());

function pointOf(event) {
  const box = stage.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

function tellPixelAt([px, py]) {
  view.pixel = [clamp(Math.floor(view.x + (px - stage.clientWidth / 2) / scale()), 0, frame.width - 1),
                clamp(Math.floor(view.y + (py - stage.clientHeight / 2) / scale()), 0, frame.height - 1)];
  update();
}

function moveSplit(by) {
  view.split = clamp(view.split + by, 0, 1);
  update();
}

function movePixel(dx, dy) {
  view.pixel = [clamp(view.pixel[0] + dx, 0, frame.width - 1), clamp(view.pixel[1] + dy, 0, frame.height - 1)];
  const [px, py] = placeOfPixel();  // a pixel that leaves the stage takes the picture along
  view.x += (px - clamp(px, 0, stage.clientWidth)) / scale();
  view.y += (py - clamp(py, 0, stage.clientHeight)) / scale();
  update();
}

function changeExposure(by) {
  view.exposure = clamp(view.exposure + by, -10, 10);
  update();
}

function fit() {
  view.scale = 0;
  update();
}

function exchange() {
  [view.left, view.right] = [view.right, view.left];
  update();
}

const fingers = new Map();  // pointers that are down, and where
let drags = 'nothing';      // or the line, or the picture

function pressed(event) {
  const point = pointOf(event);
  fingers.set(event.pointerId, point);
  stage.setPointerCapture(event.pointerId);
  const onLine = Math.abs(point[0] - view.split * stage.clientWidth) <= 20;
  drags = onLine || view.scale === 0 ? 'line' : 'picture';
  if (!onLine) tellPixelAt(point);
}

function moved(event) {
  const before = fingers.get(event.pointerId), point = pointOf(event);
  if (!before) return event.pointerType === 'mouse' && tellPixelAt(point);
  const others = [...fingers].filter(([id]) => id !== event.pointerId);
  fingers.set(event.pointerId, point);
  if (others.length === 1) return pinched(others[0][1], before, point);
  if (drags === 'line') return moveSplit((point[0] - before[0]) / stage.clientWidth);
  view.x -= (point[0] - before[0]) / scale();
  view.y -= (point[1] - before[1]) / scale();
  update();
}

function pinched(other, before, point) {
  const distance = ([x, y]) => Math.max(Math.hypot(x - other[0], y - other[1]), 1);
  zoom(distance(point) / distance(before), [(point[0] + other[0]) / 2, (point[1] + other[1]) / 2]);
}

function released(event) {
  fingers.delete(event.pointerId);
}

function wheel(event) {
  if (!event.ctrlKey && document.activeElement !== stage) return;  // the page scrolls
  event.preventDefault();
  zoom(2 ** (-clamp(event.deltaY, -100, 100) / 200), pointOf(event));
}

const keys = {
  ArrowLeft: step => movePixel(-step, 0), ArrowRight: step => movePixel(step, 0),
  ArrowUp: step => movePixel(0, -step), ArrowDown: step => movePixel(0, step),
  '+': () => zoomOnPixel(2), '=': () => zoomOnPixel(2), '-': () => zoomOnPixel(0.5),
  '0': fit, '1': () => zoomOnPixel(1 / scale()),
  '[': () => moveSplit(-0.02), ']': () => moveSplit(0.02),
  e: () => changeExposure(0.25), d: () => changeExposure(-0.25), x: exchange,
};

function keyPressed(event) {
  const action = keys[event.key];
  if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  action(event.shiftKey ? 10 : 1);
}

// ---- the beginning -----------------------------------------------------------------------------------------------------

function connect() {
  for (const side of ['left', 'right']) {
    layers.forEach((layer, i) => element(side).add(new Option(layer.name, i)));
    element(side).onchange = () => { view[side] = Number(element(side).value); update(); };
  }
  for (const name of Object.keys(tones)) element('tone').add(new Option(name));
  element('tone').onchange = () => { view.tone = element('tone').value; update(); };
  element('exposure').oninput = () => { view.exposure = Number(element('exposure').value); update(); };
  element('split').oninput = () => { view.split = element('split').value / 1000; update(); };
  element('in').onclick = () => zoomOnPixel(2);
  element('out').onclick = () => zoomOnPixel(0.5);
  element('fit').onclick = fit;
  element('one').onclick = () => zoomOnPixel(1 / scale());
  stage.onpointerdown = pressed;
  stage.onpointermove = moved;
  stage.onpointerup = stage.onpointercancel = released;
  stage.onkeydown = keyPressed;
  stage.addEventListener('wheel', wheel, {passive: false});
  window.onresize = resize;
}

async function begin() {
  layers = await Promise.all(frame.layers.map(async (layer, i) => {
    const own = document.createElement('canvas');
    own.width = frame.width;
    own.height = frame.height;
    return {...layer, canvas: own, planes: await decode(i, layer.channels.length)};
  }));
  connect();
  resize();
  element('stage').dataset.ready = 'yes';
}

begin().catch(error => {
  element('failure').hidden = false;
  element('failure').textContent = 'The pictures cannot be shown: ' + error.message + '. A browser of 2023 or later is needed.';
});
