// What the user takes home: the strips as CSV, the picture as PNG, the last minute as a recording.
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

/** The picture with its clearance view, and the strips below it. @param view  that has just drawn all of it */
export async function pngOf({ canvas: sceneCanvas, closeUp }, stripCanvases, { background, ink }, title) {
  const width = sceneCanvas.width, rowHeight = 90, titles = 18;
  const columns = 4, rows = Math.ceil(stripCanvases.length / columns);
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = sceneCanvas.height + rows * (rowHeight + titles) + 8;
  const context = canvas.getContext('2d');
  context.fillStyle = background;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(sceneCanvas, 0, 0);
  const { box } = closeUp, scale = width / sceneCanvas.clientWidth;
  if (!box.hidden) context.drawImage(closeUp.canvas, box.offsetLeft * scale, box.offsetTop * scale, box.offsetWidth * scale, box.offsetHeight * scale);
  context.fillStyle = ink;
  context.font = '16px system-ui, "DejaVu Sans", sans-serif';
  context.fillText(title, 14, 26);
  context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  stripCanvases.forEach((strip, i) => {
    const x = (i % columns) * width / columns + 6, y = sceneCanvas.height + Math.floor(i / columns) * (rowHeight + titles);
    context.fillText(`${strip.ariaLabel}  ${strip.parentElement.querySelector('output').textContent}`, x, y + 13, width / columns - 12);
    context.drawImage(strip, x, y + titles, width / columns - 12, rowHeight - 6);
  });
  return new Promise((resolve) => canvas.toBlob(resolve, 'image/png'));
}
