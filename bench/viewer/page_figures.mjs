// How fast the page is on a machine without a graphics processor: its size, its first picture, and pictures a second with 100,352 triangles.
// usage: node page_figures.mjs feeler-demo modules-folder chromium [seconds]
import { readFileSync, readdirSync } from 'node:fs';
import os from 'node:os';
import { LiveDemo, startBrowser } from '../../test/viewer/live_demo.mjs';

const [program, modules, chromiumPath, secondsGiven] = process.argv.slice(2);
const seconds = Number(secondsGiven ?? 6);
const largestPage = 1.5e6;  // [bytes]

/** Processor time of this program's descendants [ms], by the kind of process of Chromium. */
function processorTimes() {
  const processes = new Map();
  for (const id of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const stat = readFileSync(`/proc/${id}/stat`, 'utf8');
      const words = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
      const kind = readFileSync(`/proc/${id}/cmdline`, 'utf8').match(/--type=([\w-]+)/)?.[1] ?? 'other';
      processes.set(Number(id), { parent: Number(words[1]), time: 10 * (Number(words[11]) + Number(words[12])), kind });
    } catch { /* it has ended */ }
  }
  const isBelow = (id) => id === process.pid || (processes.has(id) && isBelow(processes.get(id).parent));
  const times = { renderer: 0, 'gpu-process': 0 };
  for (const [id, { kind, time, parent }] of processes) if (kind in times && isBelow(parent)) times[kind] += time;
  return times;
}

async function measure(browser, url, viewport) {
  const context = await browser.newContext({ viewport, bypassCSP: true });
  const page = await context.newPage();
  await page.goto(url);
  await page.waitForFunction(() => window.feeler?.view.firstPicture !== null && feeler.timeline.latest?.mode === 'motion', null, { timeout: 60000 });
  const first = await page.evaluate(() => feeler.view.firstPicture);
  await page.waitForTimeout(2000);  // until it knows how many pixels this machine draws
  const state = () => page.evaluate(() => ({ time: performance.now(), frames: feeler.view.framesDrawn, pixels: feeler.view.pixels }));
  const [before, timesBefore] = [await state(), processorTimes()];
  await page.waitForTimeout(1000 * seconds);
  const [after, timesAfter] = [await state(), processorTimes()];
  await context.close();
  const frames = after.frames - before.frames;
  const perFrame = (kind) => ((timesAfter[kind] - timesBefore[kind]) / Math.max(frames, 1)).toFixed(1);
  return {
    picture: `${viewport.width} × ${viewport.height}`, 'first picture, s': (first / 1000).toFixed(2), 'pictures a second': (1000 * frames / (after.time - before.time)).toFixed(1),
    'pixels a CSS pixel': after.pixels.toFixed(2), 'drawing, ms of a processor a picture': perFrame('gpu-process'), 'page, ms a picture': perFrame('renderer'),
  };
}

const demo = await LiveDemo.start(program, '--view', '--scene', 'terrain', '--triangles', '100352', '--play', '--port', '0');
const browser = await startBrowser(modules, chromiumPath);
const loadBefore = os.loadavg()[0];
const rows = [];
for (const viewport of [{ width: 1366, height: 768 }, { width: 1920, height: 1080 }]) rows.push(await measure(browser, demo.url, viewport));
await browser.close();
const size = (await (await fetch(demo.url)).arrayBuffer()).byteLength;
await demo.stop();
console.log(`${os.cpus().length} processors, ${os.cpus()[0].model}, load ${loadBefore.toFixed(1)} before and ${os.loadavg()[0].toFixed(1)} after`);
console.log(`the page has ${(size / 1e6).toFixed(2)} MB`);
for (const row of rows) console.log(Object.entries(row).map(([name, value]) => `${name}: ${value}`).join('; '));
if (!(size < largestPage) || rows.some((row) => !(Number(row['pictures a second']) > 0))) {
  console.log('FAILED: the page is too large, or draws nothing');
  process.exit(1);
}
