// What the user takes home: the samples as CSV, the picture with its strips as PNG.
import { sampleColumns } from './protocol.js';

export function download(name, blob) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** All samples that are kept, one a line; SI units, times of computation in microseconds. */
export function csvOf({ samples }) {
  const lines = [sampleColumns.join(',')];
  for (let i = 0; i < samples.count; ++i) lines.push(sampleColumns.map((_, column) => samples.value(i, column)).join(','));
  return `${lines.join('\n')}\n`;
}

/** Writes a text where the page has it, line by line. */
function paintText(context, node) {
  const style = getComputedStyle(node.parentElement), range = document.createRange();
  context.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
  context.fillStyle = style.color;
  const { fontBoundingBoxAscent: ascent, fontBoundingBoxDescent: descent } = context.measureText('x');
  const lines = [];
  for (let i = 0; i < node.length; ++i) {
    range.setStart(node, i);
    range.setEnd(node, i + 1);
    const box = range.getClientRects()[0];
    if (!box) continue;
    if (lines.at(-1)?.box.top !== box.top) lines.push({ box, text: '' });
    lines.at(-1).text += node.data[i];
  }
  for (const { box, text } of lines) context.fillText(text, box.left, (box.top + box.bottom + ascent - descent) / 2);
}

/** Paints an element as the page shows it: its ground, its borders, its canvas, its words, and what is in it. */
function paint(context, node) {
  if (node.nodeType === Node.TEXT_NODE) return paintText(context, node);
  const box = node.nodeType === Node.ELEMENT_NODE && node.getBoundingClientRect();
  if (!box || box.width === 0 || box.height === 0) return undefined;
  const style = getComputedStyle(node), [top, right, bottom, left] = ['Top', 'Right', 'Bottom', 'Left'].map((side) => parseFloat(style[`border${side}Width`]));
  context.save();
  context.fillStyle = style.backgroundColor;
  context.beginPath();
  context.roundRect(box.left, box.top, box.width, box.height, parseFloat(style.borderTopLeftRadius) || 0);
  context.fill();
  if (style.overflowX !== 'visible') context.clip();
  if (node.tagName === 'CANVAS') context.drawImage(node, box.left, box.top, box.width, box.height);
  for (const child of node.childNodes) paint(context, child);
  const border = (colour, ...rectangle) => {
    context.fillStyle = colour;
    context.fillRect(...rectangle);
  };
  border(style.borderTopColor, box.left, box.top, box.width, top);
  border(style.borderRightColor, box.right - right, box.top, right, box.height);
  border(style.borderBottomColor, box.left, box.bottom - bottom, box.width, bottom);
  border(style.borderLeftColor, box.left, box.top, left, box.height);
  return context.restore();
}

/** Elements of the page as they are seen now, pictures, words and all. */
export function pngOf(elements, ground) {
  const margin = 8, boxes = elements.map((element) => element.getBoundingClientRect());
  const [left, top] = ['left', 'top'].map((side) => Math.min(...boxes.map((box) => box[side])));
  const [right, bottom] = ['right', 'bottom'].map((side) => Math.max(...boxes.map((box) => box[side])));
  const canvas = document.createElement('canvas'), ratio = devicePixelRatio;
  canvas.width = ratio * (right - left);
  canvas.height = ratio * (bottom + margin - top);
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, -ratio * left, -ratio * top);
  context.fillStyle = ground;
  context.fillRect(left, top, right - left, bottom + margin - top);
  for (const element of elements) paint(context, element);
  return new Promise((resolve) => canvas.toBlob(resolve, 'image/png'));
}
