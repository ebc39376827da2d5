// The live view as a user meets it, in headless Chromium.
// usage: node page_test.mjs feeler-demo scratch-folder modules-folder chromium [folder-of-stand-ins]
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { LiveDemo, startBrowser, until } from './live_demo.mjs';

const [demo, scratch, modules, chromiumPath, standIns = join(dirname(demo), '../../test/device/stand_in')] = process.argv.slice(2);
rmSync(scratch, { recursive: true, force: true });
mkdirSync(scratch, { recursive: true });
const startDemo = (...options) => LiveDemo.start(demo, '--view', ...options);

async function freePort() {
  const server = createServer().listen(0, '127.0.0.1');
  await new Promise((resolve) => server.on('listening', resolve));
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

const browser = await startBrowser(modules, chromiumPath);
const complaints = [];

async function open(url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 760 }, acceptDownloads: true, bypassCSP: true, ...options });
  const page = await context.newPage();
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  await page.goto(url);
  await page.waitForFunction(() => window.feeler?.view.framesDrawn > 0 && (feeler.timeline.frames.length > 2), null, { timeout: 30000 });
  return page;
}

const frame = (page) => page.evaluate(() => {
  const f = feeler.timeline.latest;
  return { haptic: f.haptic.position, graphic: f.graphic.position, force: Math.hypot(...f.force), time: f.time, mode: f.mode, stage: f.stage };
});
/** Where a point of the world is seen [CSS px]. */
const seen = (page, point) => page.evaluate(([x, y, z]) => {
  const { camera, canvas } = feeler.view;
  const p = camera.position.clone().set(x, y, z).project(camera), box = canvas.getBoundingClientRect();
  return { x: box.left + (p.x + 1) / 2 * box.width, y: box.top + (1 - p.y) / 2 * box.height };
}, point);
const nobodyMoves = (page) => page.waitForFunction(() => ['still', 'person'].includes(feeler.timeline.latest.mode));
const hideHelp = (page) => page.evaluate(() => feeler.showHelp(false));

async function choose(page, scene) {
  const before = (await frame(page)).stage;
  await page.click(`#gallery [data-scene="${scene}"]`);
  await page.waitForFunction((stage) => feeler.timeline.latest.stage > stage && feeler.stage.stage === feeler.timeline.latest.stage, before, { timeout: 60000 });
}

/** A cube, closed, its faces of four corners. */
const blockObj = (side) => [
  ...[0, 1, 2, 3, 4, 5, 6, 7].map((i) => `v ${[1, 2, 4].map((bit) => (i & bit ? side / 2 : -side / 2)).join(' ')}`),
  ...['1 3 4 2', '5 6 8 7', '1 2 6 5', '3 7 8 4', '1 5 7 3', '2 4 8 6'].map((face) => `f ${face}`), ''].join('\n');

/** A bumpy ring as binary STL, of 2·n² triangles. */
function ringStl(n) {
  const point = (i, j) => {
    const [u, v] = [i, j].map((k) => 2 * Math.PI * (k % n) / n), r = 15 + Math.sin(30 * u) * Math.sin(20 * v), away = 40 + r * Math.cos(v);
    return [away * Math.cos(u), away * Math.sin(u), r * Math.sin(v)];
  };
  const bytes = Buffer.alloc(84 + 100 * n * n);
  let at = bytes.writeUInt32LE(2 * n * n, 80);
  for (let k = 0; k < n * n; ++k) {
    const i = Math.floor(k / n), j = k % n, [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
    for (const corners of [[a, b, c], [a, c, d]]) {
      at += 12;
      for (const x of corners.flat()) at = bytes.writeFloatLE(x, at);
      at += 2;
    }
  }
  return bytes;
}

/** Until it is on show, and its sentence is said. */
async function openMesh(page, name, text) {
  await page.setInputFiles('#open-mesh', { name, mimeType: 'model/obj', buffer: Buffer.from(text) });
  await page.waitForFunction((title) => feeler.stage.title === title && feeler.stage.stage === feeler.timeline.latest.stage
    && document.getElementById('sentence').textContent.startsWith(title) && !document.getElementById('sentence').hidden, name);
}

const tests = {
  async nothing_moves_before_somebody_moves_it(page) {
    const a = await frame(page);
    await page.waitForTimeout(400);
    const b = await frame(page);
    assert.equal(b.mode, 'still');
    assert.ok(b.time > a.time, 'the loop runs');
    assert.deepEqual(a.graphic, b.graphic);
  },

  async a_drag_pushes_the_tool_against_a_wall_and_the_force_rises(page) {
    await hideHelp(page);
    const { haptic } = await frame(page);
    const from = await seen(page, haptic);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    for (let i = 1; i <= 20; ++i) {
      await page.mouse.move(from.x, from.y - 8 * i);
      await page.waitForTimeout(30);
    }
    await page.waitForFunction(() => Math.hypot(...feeler.timeline.latest.force) > 1);
    const pressed = await frame(page);
    await page.mouse.up();
    assert.ok(pressed.haptic[2] - pressed.graphic[2] > 5e-4, 'the hand is in the wall, the tool is not');
    const outside = await page.evaluate(() => {
      // The corners of the cube of 20 mm in the room of 40 × 21 × 30 mm: the closed form is the checker.
      const room = [0.02, 0.0105, 0.015], { position, quaternion } = feeler.timeline.latest.graphic;
      const { Vector3, Quaternion } = { Vector3: feeler.view.camera.position.constructor, Quaternion: feeler.view.camera.quaternion.constructor };
      const turn = new Quaternion(...quaternion);
      let worst = -1;
      for (let i = 0; i < 8; ++i) {
        const corner = new Vector3(i & 1 ? 0.01 : -0.01, i & 2 ? 0.01 : -0.01, i & 4 ? 0.01 : -0.01).applyQuaternion(turn).add(new Vector3(...position));
        corner.toArray().forEach((v, k) => (worst = Math.max(worst, Math.abs(v) - room[k])));
      }
      return worst;
    });
    assert.ok(outside < 1e-11, `a corner is ${outside} m in the wall`);
    const strip = await page.textContent('#strips figure:first-child output');
    assert.match(strip, /N/);
    assert.match(await page.textContent('.readings'), /F|E|V/);
  },

  async keys_move_the_hand_and_stop_when_they_are_let_go(page) {
    const before = await frame(page);
    await page.focus('#first canvas[tabindex]');
    await page.keyboard.down('d');
    await page.waitForTimeout(400);
    await page.keyboard.up('d');
    await nobodyMoves(page);
    await page.waitForFunction((p) => Math.hypot(...feeler.timeline.latest.haptic.position.map((v, i) => v - p[i])) > 5e-4, before.haptic);
    await page.waitForFunction(() => {  // it comes to rest, and so stays for a quarter of a second of the loop
      const { frames, latest } = feeler.timeline, past = feeler.timeline.frameAt(latest.time - 0.25);
      return frames.length > 2 && Math.hypot(...latest.haptic.position.map((v, i) => v - past.haptic.position[i])) < 1e-4;
    });
  },

  async a_finger_drags_the_tool_and_two_turn_it(page) {
    await choose(page, 'cavity');
    const cdp = await page.context().newCDPSession(page);
    const touch = (type, ...points) => cdp.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const before = await page.evaluate(() => feeler.timeline.latest.haptic);
    const at = await seen(page, before.position);
    await touch('touchStart', [at.x, at.y]);
    for (let i = 1; i <= 10; ++i) await touch('touchMove', [at.x + 6 * i, at.y]);
    await page.waitForFunction((p) => Math.hypot(...feeler.timeline.latest.haptic.position.map((v, k) => v - p[k])) > 1e-3, before.position);
    const there = [at.x + 60, at.y];
    await touch('touchStart', there, [there[0] + 80, there[1]]);
    for (let i = 1; i <= 10; ++i) await touch('touchMove', there, [there[0] + 80 * Math.cos(i / 20), there[1] + 80 * Math.sin(i / 20)]);
    await page.waitForFunction((q) => Math.abs(feeler.timeline.latest.haptic.quaternion.reduce((sum, v, k) => sum + v * q[k], 0)) < 0.995, before.quaternion);
    await touch('touchEnd');
    await nobodyMoves(page);
  },

  async the_stick_of_a_game_controller_moves_the_hand(page) {
    await choose(page, 'cavity');
    const { haptic } = await frame(page);
    await page.evaluate(() => {
      window.stick = { axes: [0.6, 0, 0, 0], buttons: [] };
      navigator.getGamepads = () => [window.stick];
      dispatchEvent(new Event('gamepadconnected'));
    });
    await page.waitForFunction((p) => Math.hypot(...feeler.timeline.latest.haptic.position.map((v, k) => v - p[k])) > 1e-3, haptic);
    await page.evaluate(() => (navigator.getGamepads = () => []));
  },

  async every_scene_shows_its_motion(page) {
    const scenes = await page.evaluate(() => feeler.live.greeting.gallery.map(({ id }) => id));
    assert.ok(scenes.includes('cavity') && scenes.includes('spline') && scenes.includes('shaft'));
    for (const scene of scenes) {
      await choose(page, scene);
      const before = await frame(page);
      await page.click('#show');
      await page.waitForFunction((g) => Math.hypot(...feeler.timeline.latest.graphic.position.map((v, i) => v - g[i])) > 1e-3, before.graphic);
      await page.click('#still');
      await page.waitForFunction(() => feeler.timeline.latest.mode === 'still');
    }
  },

  async settings_are_switched_live_and_bad_ones_refused_in_words(page) {
    await choose(page, 'cavity');
    const before = (await frame(page)).stage;
    await page.selectOption('#settings select[name=variant]', { index: 1 });
    await page.waitForFunction((stage) => feeler.stage.stage > stage && feeler.stage.variant === 'cavity 10 µm', before);
    await page.selectOption('#settings select[name=margin]', '1e-7');
    await page.waitForFunction(() => feeler.stage.margin === 1e-7);
    await page.selectOption('#settings select[name=tool]', 'pebble');
    await page.waitForFunction(() => feeler.stage.tool_kind === 'pebble' && feeler.stage.tool[0].vertices.length > 8);
    await page.selectOption('#settings select[name=scalar]', 'float');
    await page.waitForFunction(() => feeler.stage.scalar === 'float');
    await page.evaluate(() => feeler.live.source.send({ type: 'scene', scene: 'moon' }));
    await page.waitForFunction(() => /no scene moon/.test(document.getElementById('sentence').textContent));
    await page.evaluate(() => feeler.live.source.send({ type: 'hand', stage: 1, position: [0, 0, 1e9], orientation: [1, 0, 0, 0] }));
    await page.waitForFunction(() => /out of range/.test(document.getElementById('sentence').textContent));
    const { time } = await frame(page);
    await page.waitForFunction((t) => feeler.timeline.latest.time > t, time);
  },

  async an_own_mesh_is_opened_felt_and_put_in_the_gallery(page) {
    await openMesh(page, 'block.obj', blockObj(0.05));
    const sentence = await page.textContent('#sentence');
    assert.match(sentence, /block\.obj: 12 triangles on 8 vertices; a closed surface/);
    assert.match(await page.textContent('#gallery button:first-child'), /block\.obj/);
    assert.equal(await page.getAttribute('#gallery button:first-child', 'aria-current'), 'true');
    const before = await frame(page);
    assert.equal(before.mode, 'still');
    assert.ok(before.force < 1e-6, 'it begins free');
    await page.waitForFunction(() => !feeler.live.work);
    await page.click('#show');
    await page.waitForFunction(() => Math.hypot(...feeler.timeline.latest.force) > 0.5);
    const inside = await page.evaluate(() => {
      const { graphic } = feeler.timeline.latest, { camera } = feeler.view, [Vector3, Quaternion] = [camera.position.constructor, camera.quaternion.constructor];
      const corners = feeler.stage.tool[0].vertices.map((v) => new Vector3(...v).applyQuaternion(new Quaternion(...graphic.quaternion)).add(new Vector3(...graphic.position)));
      return Math.max(...corners.map((p) => 0.025 - Math.max(...p.toArray().map(Math.abs))));
    });
    assert.ok(inside < 1e-11, `a corner is ${inside} m in the block`);
    await choose(page, 'cavity');
    await page.click('#gallery button:first-child');
    await page.waitForFunction(() => feeler.stage.title === 'block.obj');
  },

  async millimetres_are_guessed_said_and_can_be_chosen_otherwise(page) {
    await openMesh(page, 'large <b>&.obj', blockObj(50));
    assert.match(await page.textContent('#sentence'), /large <b>&\.obj: .*closed surface\. Taken as 50 mm × 50 mm × 50 mm, its numbers in millimetres, which is a guess/);
    assert.equal(await page.inputValue('#settings select[name=variant]'), 'in millimetres');
    const width = () => page.evaluate(() => 2 * feeler.view.object.halfSize.x);
    assert.ok(Math.abs((await width()) - 0.05) < 1e-6);
    await page.selectOption('#settings select[name=variant]', 'in inches');
    await page.waitForFunction(() => feeler.stage.variant === 'in inches' && Math.abs(2 * feeler.view.object.halfSize.x - 50 * 0.0254) < 1e-5);
  },

  async a_unit_that_is_chosen_is_no_guess(page) {
    await page.selectOption('#unit', 'mm');
    await openMesh(page, 'small.obj', blockObj(0.5));
    assert.match(await page.textContent('#sentence'), /Taken as 500 µm × 500 µm × 500 µm, its numbers in millimetres\.$/);
    await page.selectOption('#unit', '');
    await openMesh(page, 'small.obj', blockObj(0.5));
    assert.match(await page.textContent('#sentence'), /Taken as 500 mm × 500 mm × 500 mm, its numbers in metres, which is a guess/);
    await openMesh(page, 'small.obj', blockObj(1));
    assert.match(await page.textContent('#sentence'), /Taken as 1 mm × .*in millimetres, which is a guess/);
  },

  async the_opening_of_a_large_mesh_is_ended_by_cancel_and_by_a_newer_choice(page) {
    const large = { name: 'large.stl', mimeType: 'model/stl', buffer: ringStl(600) };
    const { stage } = await frame(page);
    const openIt = async () => {
      await page.setInputFiles('#open-mesh', large);
      await page.waitForFunction(() => /Opening large.stl …/.test(document.getElementById('sentence').textContent));
      await page.waitForSelector('#cancel:visible');
    };
    await openIt();
    assert.ok(!(await page.isVisible('#open-mesh')));
    await page.click('#cancel');
    await page.waitForFunction(() => /large.stl was not opened: it was cancelled/.test(document.getElementById('sentence').textContent), null, { timeout: 1000 });
    await page.waitForSelector('#open-mesh:visible');
    await openIt();
    await page.click('#gallery [data-scene="steps"]');
    await page.waitForFunction(() => feeler.stage.scene === 'steps', null, { timeout: 2000 });
    await page.waitForFunction(() => /large.stl was not opened: something else was chosen/.test(document.getElementById('sentence').textContent));
    await page.waitForTimeout(8000);  // what was cancelled does not come later
    assert.equal((await page.evaluate(() => feeler.stage.scene)), 'steps');
    assert.ok((await frame(page)).stage > stage);
    assert.ok(!(await page.evaluate(() => feeler.live.greeting.gallery.some(({ title }) => title === 'large.stl'))));
  },

  async a_folder_that_is_dropped_is_refused_in_words(page) {
    await page.evaluate(() => {
      const entry = { isDirectory: true, name: 'parts' };
      document.body.dispatchEvent(Object.assign(new Event('drop', { bubbles: true }),
        { dataTransfer: { items: [{ webkitGetAsEntry: () => entry }], files: [new File([], 'parts')] } }));
    });
    assert.match(await page.textContent('#sentence'), /^parts is a folder: drop the file/);
  },

  async a_mesh_can_be_dropped_and_the_same_name_takes_its_place(page) {
    const entries = () => page.evaluate(() => feeler.live.greeting.gallery.filter(({ title }) => title === 'block.obj').length);
    assert.equal(await entries(), 1);
    const before = (await frame(page)).stage;
    await page.evaluate((text) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], 'block.obj'));
      document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true }));
    }, blockObj(0.02));
    await page.waitForFunction((stage) => feeler.stage.stage > stage && feeler.stage.title === 'block.obj', before);
    assert.equal(await entries(), 1);
  },

  async files_that_are_no_mesh_are_refused_in_words_and_the_loop_goes_on(page) {
    const { stage } = await frame(page);
    const bad = {
      'empty.stl': ['', /is empty/], 'notes.txt': ['hello', /of no kind that is read here/], 'noise.ply': ['ply\nnoise', /cannot be read as a mesh: it is damaged/],
      'points.obj': ['v 0 0 0\nv 1 0 0\n', /cannot be read as a mesh|no triangles/], 'nan.off': ['OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n', /NaN|cannot be read/],
      'far.off': ['OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n', /far.off(:| cannot| has)/], 'huge.off': ['OFF\n4000000000 4000000000 0\n', /cannot be read/],
      'short.off': ['OFF\n8 12 0\n3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n3 0 1 5\n3 0 5 4\n3 2 6 7\n3 2 7 3', /cannot be read: its reader failed/],  // ends its reader
      'damaged.stl': [Buffer.alloc(90, 1), /cannot be read as a mesh: it is damaged/],
      'materials.obj': [`mtllib /dev/zero\n${blockObj(0.03)}`, /materials.obj: 12 triangles/],
    };
    for (const [name, [text, answer]] of Object.entries(bad)) {
      await page.setInputFiles('#open-mesh', { name, mimeType: 'model/any', buffer: Buffer.from(text) });
      await page.waitForFunction(([source, nameIn]) => {
        const { textContent } = document.getElementById('sentence');
        return new RegExp(source).test(textContent) && textContent.includes(nameIn);
      }, [answer.source, name]).catch(async () => assert.fail(`${name}: ${await page.textContent('#sentence')}`));
      assert.doesNotMatch(await page.textContent('#sentence'), /\$\$\$|std::/);
    }
    const large = join(scratch, 'large.stl');
    writeFileSync(large, Buffer.alloc(64 * 2 ** 20 + 1));
    await page.setInputFiles('#open-mesh', large);
    await page.waitForFunction(() => /large.stl is too large: 64 MB/.test(document.getElementById('sentence').textContent));
    const { time } = await frame(page);
    await page.waitForFunction((t) => feeler.timeline.latest.time > t, time);
    assert.ok((await frame(page)).stage >= stage);
    complaints.length = 0;  // the browser notes each refusal
  },

  async pausing_keeps_the_moment_and_scrolls_back(page) {
    await choose(page, 'steps');
    await page.click('#show');
    await page.waitForTimeout(1500);
    await page.click('#pause');
    const paused = await page.evaluate(() => feeler.player.cursor);
    const shown = await page.evaluate(() => feeler.view.frame.time);
    await page.click('#back');
    await page.waitForTimeout(100);
    assert.ok((await page.evaluate(() => feeler.view.frame.time)) < shown);
    assert.ok((await page.evaluate(() => feeler.player.cursor)) < paused);
    await page.hover('#strip-force', { position: { x: 100, y: 30 } });
    assert.match(await page.textContent('#strips figure:first-child output'), /N/);
    await page.click('#live');
    await page.waitForFunction((t) => feeler.view.frame.time > t, paused);
  },

  async the_figures_in_the_corner_are_those_of_the_strips(page) {
    await choose(page, 'spline');
    await page.click('#show');
    for (let i = 0; i < 10; ++i) {
      await page.waitForTimeout(90);
      const [corner, strips] = await page.evaluate(() => {
        const figure = (id) => document.getElementById(`strip-${id}`).parentElement.querySelector('output').textContent;
        const [force, torque, , apart] = [...document.querySelectorAll('#first .readings dd')].map((dd) => dd.textContent);
        return [[force, torque, apart], [figure('force'), figure('torque'), `${figure('offset')}, ${figure('turn')}`]];
      });
      assert.deepEqual(corner, strips);
    }
    await page.click('#still');
  },

  async a_choice_of_another_page_does_not_end_a_look_at_the_past(page) {
    await choose(page, 'steps');
    await page.click('#pause');
    const { cursor, stage } = await page.evaluate(() => ({ cursor: feeler.player.cursor, stage: feeler.stage.stage }));
    const other = await open(page.url());
    await choose(other, 'tunnel');
    await page.waitForFunction(() => /Another page has chosen Tunnel of thin walls/.test(document.getElementById('sentence').textContent));
    assert.deepEqual(await page.evaluate(() => ({ cursor: feeler.player.cursor, stage: feeler.stage.stage })), { cursor, stage });
    await page.click('#live');
    await page.waitForFunction(() => feeler.stage.scene === 'tunnel' && feeler.view.mesh && feeler.view.frame?.stage === feeler.stage.stage);
    await page.click('#pause');
    await choose(page, 'cavity');  // one's own goes live
    assert.ok(await page.evaluate(() => feeler.player.isLive));
    await other.context().close();
  },

  async samples_picture_and_recording_are_saved(page) {
    const save = async (button) => {
      await page.evaluate(() => (document.querySelector('.menu').open = true));
      const [download] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
      const path = join(scratch, download.suggestedFilename());
      await download.saveAs(path);
      return path;
    };
    const csv = readFileSync(await save('#save-csv'), 'utf8').split('\n');
    assert.match(csv[0], /^time,fx,fy,fz/);
    assert.ok(csv.length > 1000);
    const times = csv.slice(1, -1).map((line) => Number(line.split(',')[0]));
    assert.ok(times.every((t, i) => i === 0 || t > times[i - 1]), 'every tick once, in order');
    await page.click('#pause');
    const picture = await page.evaluate(async (png) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob());
      const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height }), context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      const inkIn = (left, y, width, height) => context.getImageData(left, y, width, height).data.filter((v, i) => i % 4 === 1 && v < 120).length;
      const strips = document.getElementById('strips').getBoundingClientRect(), caption = document.querySelector('#strips figcaption').getBoundingClientRect();
      const words = document.querySelector('#first .words').getBoundingClientRect();
      return { width: image.width, strips: document.querySelector('footer').clientWidth,
        title: inkIn(8, 8, words.width, words.height), caption: inkIn(caption.left - strips.left, image.height - 8 - (strips.bottom - caption.top), caption.width, caption.height) };
    }, readFileSync(await save('#save-png')).toString('base64'));
    assert.equal(picture.width, picture.strips, 'as wide as the strips are');
    assert.ok(picture.title > 100 && picture.caption > 20, `title and captions are in it: ${JSON.stringify(picture)}`);
    assert.ok(!(await page.evaluate(() => document.body.classList.contains('saving'))));
    await page.click('#live');
    const recording = await save('#save-recording');
    const other = await open(page.url());
    await other.setInputFiles('#open-recording', [recording, recording]);
    await other.waitForFunction(() => feeler.recordings.length === 2 && feeler.panes[1].view.framesDrawn > 0);
    await other.evaluate(() => {
      const slider = document.getElementById('time');
      slider.value = (feeler.timeline.begin + feeler.timeline.end) / 2;
      slider.dispatchEvent(new Event('input'));
    });
    const { cursor, middle } = await other.evaluate(() => ({ cursor: feeler.player.cursor, middle: (feeler.timeline.begin + feeler.timeline.end) / 2 }));
    assert.ok(Math.abs(cursor - middle) < 2e-3, 'the slider belongs to the recording');
    await other.setInputFiles('#open-recording', { name: 'bad.json', mimeType: 'application/json', buffer: Buffer.from('{}') });
    await other.waitForFunction(() => /no recording/.test(document.getElementById('sentence').textContent));
    await other.click('#live');  // the loop runs on
    await other.waitForFunction(() => window.feeler?.player?.isLive && feeler.timeline.latest?.time > 0);
    await other.context().close();
  },

  async the_keyboard_reaches_every_control(page) {
    const count = await page.evaluate(() => [...document.querySelectorAll('button, select, input, summary, canvas[tabindex]')]
      .filter((node) => node.offsetParent !== null && !node.disabled && node.closest('details:not([open]) > div') === null).length);
    await page.evaluate(() => document.activeElement.blur());
    const reached = new Set();
    for (let i = 0; i < count + 12; ++i) {
      await page.keyboard.press('Tab');
      reached.add(await page.evaluate(() => {
        const nodes = [...document.querySelectorAll('button, select, input, summary, canvas[tabindex]')];
        return nodes.indexOf(document.activeElement);
      }));
    }
    reached.delete(-1);
    assert.ok(reached.size >= count - 2, `${reached.size} of ${count}`);
  },

  async the_view_turns_and_zooms_by_keys(page) {
    const eye = () => page.evaluate(() => feeler.view.camera.position.clone().sub(feeler.view.controls.target).toArray());
    await page.focus('#first canvas[tabindex]');
    await page.keyboard.press('Home');
    const before = await eye();
    await page.keyboard.press('l');
    const turned = await eye();
    await page.keyboard.press('+');
    const nearer = await eye();
    assert.ok(Math.abs(Math.hypot(...turned) / Math.hypot(...before) - 1) < 1e-6 && Math.hypot(...turned.map((v, k) => v - before[k])) > 0.05 * Math.hypot(...before));
    assert.ok(Math.hypot(...nearer) < 0.95 * Math.hypot(...turned));
    await page.keyboard.press('Home');
    assert.ok(Math.hypot(...(await eye()).map((v, k) => v - before[k])) < 1e-6 * Math.hypot(...before));
  },

  async the_clearance_view_shows_the_cut_of_the_tightest_place(page) {
    await choose(page, 'shaft');
    await page.check('#look [name=magnify]');
    await page.click('#show');
    await page.waitForFunction(() => feeler.view.closeUp.place?.gap > 0);
    await page.click('#still');
    const shares = await page.evaluate(async () => {
      await new Promise((resolve) => setTimeout(resolve, 500));
      const { canvas } = feeler.view.closeUp, { object, graphic } = feeler.view.palette;
      const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
      const share = (hex) => {
        const wanted = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
        let count = 0;
        for (let i = 0; i < pixels.length; i += 4) count += wanted.every((v, k) => pixels[i + k] === v) ? 1 : 0;
        return 4 * count / pixels.length;
      };
      return [share(object), share(graphic)];
    });
    assert.ok(Math.min(...shares) > 0.1, `wall and tool fill ${shares.map((v) => (100 * v).toFixed(0))} % of it`);
    assert.match(await page.textContent('.close-up .caption'), /gap .*m/);
    await page.uncheck('#look [name=magnify]');
  },

  async nothing_moves_by_style(page) {
    assert.equal(await page.evaluate(() => document.getAnimations().length), 0);
    assert.ok(await page.evaluate(() => [...document.querySelectorAll('*')].every((node) => getComputedStyle(node).transitionDuration.split(', ').every((t) => t === '0s'))));
  },

  async words_have_contrast_in_both_themes(page) {
    for (const theme of ['light', 'dark']) {
      await page.evaluate((name) => feeler.setTheme(name), theme);
      const worst = await page.evaluate(() => {
        const channel = (v) => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
        const parsed = (text) => {  // red, green, blue of 255, and opacity
          if (/^#/.test(text)) return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16)).concat(1);
          const numbers = text.match(/[\d.]+/g).map(Number);
          return [...numbers.slice(0, 3).map((v) => (text.startsWith('color(') ? 255 * v : v)), numbers[3] ?? 1];
        };
        const luminance = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
        const over = ([r, g, b, a], ground) => [r, g, b].map((v, k) => a * v + (1 - a) * ground[k]);
        const object = parsed(feeler.view.palette.object), shades = [object, object.map((v) => 0.3 * v)];  // what may be seen through
        const groundsOf = (node) => {
          const layers = [];
          for (; node; node = node.parentElement) {
            const colour = parsed(getComputedStyle(node).backgroundColor);
            if (colour[3] > 0) layers.unshift(colour);
            if (colour[3] === 1) break;
          }
          const ground = layers.shift();
          return [ground, ...(layers.length > 0 ? shades : [])].map((g) => layers.reduce((below, layer) => over(layer, below), g));
        };
        const nodes = [...document.querySelectorAll('button, label, p, h2, small, output, dt, dd, figcaption span, .legend span, .labels span, .caption, .scale')]
          .filter((n) => n.offsetParent && n.textContent.trim() && !n.disabled);
        const ratios = nodes.flatMap((node) => groundsOf(node).map((ground) => {
          const [a, b] = [luminance(parsed(getComputedStyle(node).color)), luminance(ground)].sort((x, y) => y - x);
          return { ratio: (a + 0.05) / (b + 0.05), text: node.textContent.slice(0, 40) };
        }));
        return ratios.reduce((x, y) => (y.ratio < x.ratio ? y : x));
      });
      assert.ok(worst.ratio >= 4.5, `${theme}: ${worst.ratio.toFixed(2)} at "${worst.text}"`);
    }
  },
};

let failures = 0;
async function run(name, body) {
  try {
    await body();
    assert.deepEqual(complaints.splice(0), [], 'the page complains');
    console.log(`ok      ${name}`);
  } catch (problem) {
    ++failures;
    complaints.length = 0;
    console.log(`FAILED  ${name}: ${problem.message}`);
  }
}

const live = await startDemo('--scene', 'cavity', '--port', '0');
let page;
try {
  await run('the_page_loads_within_seconds_and_without_a_complaint', async () => { page = await open(live.url); });
  if (page) {
    for (const [name, test] of Object.entries(tests)) await run(name, () => test(page));
    await run('ten_pages_at_once_get_every_tick', async () => {
      await page.click('#still');
      const pages = [];
      for (let i = 0; i < 10; ++i) pages.push(await open(live.url, { viewport: { width: 480, height: 320 } }));
      const counts = await Promise.all(pages.map((p) => p.evaluate(async () => {
        const { samples } = feeler.timeline, missedColumn = 13;
        const begin = samples.time(samples.count - 1);
        const firstAfter = () => samples.from(begin) + 1;  // it moves where the ring is full
        while (samples.count - firstAfter() <= 500) await new Promise((resolve) => setTimeout(resolve, 100));  // on a machine as slow as it may be
        const first = firstAfter();
        let missed = 0;
        for (let i = first; i < samples.count; ++i) missed += samples.value(i, missedColumn);
        return { got: samples.count - first, missed, due: Math.round((samples.time(samples.count - 1) - begin) * 1000), lost: feeler.timeline.latest.lost };
      })));
      for (const p of pages) await p.context().close();
      for (const { got, missed, due, lost } of counts) {
        assert.equal(got + missed, due, 'every deadline is a sample or was missed');
        assert.equal(lost, 0);
      }
    });
  }
} finally {
  await page?.context().close();
  await live.stop();
}

await run('a_lost_connection_is_told_and_comes_back', async () => {
  const port = String(await freePort());
  let server = await startDemo('--scene', 'cavity', '--port', port);
  const page = await open(server.url);
  await server.stop();
  await page.waitForFunction(() => /lost/.test(document.getElementById('connection').textContent));
  server = await startDemo('--scene', 'steps', '--port', port);
  await page.waitForFunction(() => document.getElementById('connection').className === 'open' && feeler.stage.scene === 'steps', null, { timeout: 20000 });
  const second = await startDemo('--port', port);
  assert.equal(await second.ended, 2);
  assert.match(second.errors, /cannot be had/);
  await server.stop();
  await page.context().close();
  complaints.length = 0;  // the browser notes each attempt
});

await run('an_address_is_printed_that_another_room_can_open', async () => {
  const server = await startDemo('--scene', 'cavity', '--port', '0', '--listen', '0.0.0.0');
  assert.doesNotMatch(server.url, /0\.0\.0\.0/);
  assert.match(server.url, /\?token=\w{32}$/);
  assert.equal((await fetch(server.url)).status, 200);
  assert.equal((await fetch(server.url.split('?')[0])).status, 403);
  await server.stop();
});

await run('a_real_device_is_the_hand_and_the_page_only_looks', async () => {
  const library = join(standIns, 'libforce_dimension_stand_in.so');
  if (!existsSync(library)) return console.log(`skipped: there is no ${library}`);
  const server = await startDemo('--scene', 'cavity', '--port', '0', '--device', 'forcedimension', '--device-library', library);
  const page = await open(server.url);
  assert.equal((await frame(page)).mode, 'device');
  assert.match(await page.textContent('#sentence'), /You hold the .*handle/);
  assert.ok(!(await page.isVisible('#show')) && !(await page.isVisible('#still')));
  const { haptic, graphic } = await frame(page);
  assert.ok(Math.hypot(...haptic) < 1e-9 && Math.hypot(...graphic) < 1e-6, 'it begins at the start, wherever the handle is');
  const at = await seen(page, haptic);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x, at.y - 100, { steps: 5 });
  await page.mouse.up();
  await page.evaluate(() => feeler.live.source.playMotion());
  await page.waitForFunction(() => /so no page moves it/.test(document.getElementById('sentence').textContent));
  await page.waitForTimeout(200);
  assert.deepEqual((await frame(page)).haptic, haptic);
  await choose(page, 'spline');
  assert.equal((await frame(page)).mode, 'device');
  assert.ok((await page.evaluate(() => feeler.stage.stiffness)) > 0);
  await page.context().close();
  assert.equal(await server.stop(), 0);
  assert.match(server.output, /missed deadlines/);
  const missing = await startDemo('--port', '0', '--device', 'virtuose', '--device-library', '/nowhere.so');
  assert.equal(await missing.ended, 2);
  assert.equal(missing.errors.trim().split('\n').length, 1);
});

await run('a_report_plays_without_a_server_and_two_are_compared', async () => {
  const reports = [['0.001', '1'], ['0.0001', '1.5']].map(([clearance, seconds], i) => ({ clearance, seconds, out: join(scratch, `report-${i}`) }));
  for (const { clearance, seconds, out } of reports) {
    const child = spawn(demo, ['--scene', 'cavity', '--clearance', clearance, '--seconds', seconds, '--out', out], { stdio: 'ignore' });
    assert.equal(await new Promise((resolve) => child.on('exit', resolve)), 0);
  }
  const context = await browser.newContext();
  const report = await context.newPage();
  report.on('pageerror', (error) => complaints.push(error.message));
  await report.goto(pathToFileURL(join(reports[0].out, 'report.html')).href);
  await report.click('button');
  const player = await (await report.waitForSelector('#player')).contentFrame();
  await player.waitForFunction(() => window.feeler?.view.framesDrawn > 0);
  assert.ok((await player.evaluate(() => feeler.timeline.samples.count)) >= 1000);
  await player.click('#pause');
  await player.waitForFunction(() => feeler.player.cursor > 0.2);
  await context.close();

  const replay = await startDemo('--replay', reports[0].out, reports[1].out, '--port', '0');
  const page = await open(replay.url);
  assert.equal(await page.evaluate(() => feeler.recordings.length), 2);
  await page.evaluate(() => feeler.player.seek(0.5));
  const times = await page.evaluate(() => feeler.panes.map((pane) => pane.view.frame.time));
  assert.ok(Math.abs(times[0] - times[1]) < 0.002);
  await page.evaluate(() => feeler.player.seek(1.4));  // the longer one rules
  assert.ok(Math.abs((await page.evaluate(() => feeler.panes[1].view.frame.time)) - 1.4) < 0.01);
  assert.ok((await page.evaluate(() => Number(document.getElementById('time').max))) > 1.45);
  await page.waitForFunction(() => document.querySelector('#second .readings dd').textContent !== '–' && document.querySelector('#first .readings dd').textContent === '–');
  const before = await page.evaluate(() => feeler.player.cursor);
  await page.click('#back');
  assert.ok((await page.evaluate(() => feeler.player.cursor)) < before);
  await page.context().close();
  await replay.stop();
});

await browser.close();
console.log(failures === 0 ? 'the live view does what it says' : `${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
