// The modules of the page that need no browser: the wire, the timeline, recordings, numbers, sticks.
// usage: node --test modules_test.mjs
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { clipped, clippedSegment, cutMesh, cutPiece, cuttingPlane, enclose, gapBetween, loopsOf, placed } from '../../device/viewer/page/cross_section.js';
import { creaseLines } from '../../device/viewer/page/creases.js';
import { contactTypes, counted, countTypes, withUnit } from '../../device/viewer/page/format.js';
import { readSticks } from '../../device/viewer/page/gamepad.js';
import { families, palettes } from '../../device/viewer/page/palette.js';
import { readFrameAt, readMessage, sampleColumns, sampleWords } from '../../device/viewer/page/protocol.js';
import { readRecording, writeRecording } from '../../device/viewer/page/recording.js';
import { csvOf } from '../../device/viewer/page/save.js';
import { countTicks, readingAt } from '../../device/viewer/page/strips.js';
import { Timeline } from '../../device/viewer/page/timeline.js';

/** A frame as the server sends it, with a contact of a type and samples at these times. */
function frameWords(time, { type = 1, times = [time], flags = 1, missed = 0, stage = 3 } = {}) {
  const head = [1, 1, stage, 77, time, 2, 1, 2, 3, 1, 0, 0, 0, 4, 5, 6, 0, 1, 0, 0, 7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6, 1, times.length];
  const contact = [type, 0.1, 0.2, 0.3, 0, 0, 1, 1e-6, 0];
  return Float64Array.from([...head, ...contact, ...times.flatMap((t) => [t, 0, 3, 4, 0, 0, 0, 1e-3, 0.1, 20, 30, 2, 3, missed, flags])]);
}
const frame = (...of) => readFrameAt(frameWords(...of), 0).frame;

function meshBuffer() {
  const buffer = new ArrayBuffer(64 + 36 + 12);
  new Float64Array(buffer, 0, 8).set([1, 2, 3, 10, 20, 30, 3, 1]);
  new Float32Array(buffer, 64, 9).set([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  new Uint32Array(buffer, 100, 3).set([0, 1, 2]);
  return buffer;
}

test('a frame is read where the server writes it, quaternions as three.js has them', () => {
  const message = readMessage(frameWords(1.5).buffer);
  assert.equal(message.stage, 3);
  assert.equal(message.mode, 'person');
  assert.deepEqual(message.haptic, { position: [1, 2, 3], quaternion: [0, 0, 0, 1] });
  assert.deepEqual(message.graphic.quaternion, [1, 0, 0, 0]);
  assert.deepEqual(message.torque, [10, 11, 12]);
  assert.equal(message.status, 'unconverged');
  assert.equal(message.contacts[0].gap, 1e-6);
  assert.equal(message.samples.length, sampleWords);
  assert.equal(sampleColumns.length, sampleWords);
});

test('another version, another kind and a cut off recording are refused in words', () => {
  assert.throws(() => readMessage(Float64Array.of(2, 1).buffer), /another version/);
  assert.throws(() => readMessage(Float64Array.of(1, 9).buffer), /unknown kind/);
  assert.throws(() => readFrameAt(frameWords(1).subarray(0, 50), 0), /damaged/);
});

test('a mesh is read with its centre', () => {
  const mesh = readMessage(meshBuffer());
  assert.deepEqual(mesh.centre, [10, 20, 30]);
  assert.deepEqual([...mesh.indices], [0, 1, 2]);
  assert.equal(mesh.positions[3], 1);
});

test('a timeline keeps a minute of samples and frames, and finds them by time', () => {
  const timeline = new Timeline();
  timeline.restart(10);
  for (let i = 0; i < 2000; ++i) timeline.add(frame(i / 10));
  assert.equal(timeline.samples.count, 650);
  assert.ok(timeline.end - timeline.begin > 60);
  assert.equal(timeline.frameAt(180.04).time, 180);
  assert.equal(timeline.frameAt(0).time, timeline.frames[0].time);
  assert.ok(timeline.frames.length < 700);
  assert.equal(timeline.samples.time(timeline.samples.from(150.05)), 150.1);
});

test('a strip is read at the tick of a time, and nothing is read after the last', () => {
  const timeline = new Timeline(10);
  for (const time of [0.001, 0.002]) timeline.add(frame(time), true);
  assert.equal(readingAt(timeline.samples, 'force', 0.001), '5 N');
  assert.equal(readingAt(timeline.samples, 'turn', 0.002), '5.73°');
  assert.equal(readingAt(timeline.samples, 'force', 0.01), '–');
  assert.equal(readingAt(new Timeline().samples, 'force', 0), '–');
});

test('one is counted as one', () => {
  assert.equal(counted(1, 'sample'), '1 sample');
  assert.equal(counted(0, 'tick'), '0 ticks');
  assert.equal(counted(12345, 'tick'), '12,345 ticks');
});

test('ticks, missed deadlines and converged ones are counted', () => {
  const timeline = new Timeline();
  timeline.restart(1000);
  timeline.add(frame(0.003, { times: [0.001, 0.002, 0.003], missed: 2 }));
  timeline.add(frame(0.005, { times: [0.005], flags: 0 }));
  assert.deepEqual(countTicks(timeline.samples, 0.002, 1), { ticks: 3, missed: 4, converged: 2 });
});

test('a recording that is written is read again', () => {
  const stage = { stage: 3, title: 'x', tool: [] };
  const text = writeRecording(stage, meshBuffer(), [frame(1), frame(2, { type: 2, times: [1.5, 2] }), frame(3, { stage: 4 })]);
  const { mesh, timeline, stage: read } = readRecording(text);
  assert.deepEqual(read, stage);
  assert.equal(mesh.positions.length, 9);
  assert.deepEqual(timeline.frames.map((f) => f.time), [0, 1]);  // it begins at 0
  assert.deepEqual([0, 1, 2].map((i) => timeline.samples.time(i)), [0, 0.5, 1]);
  assert.deepEqual(timeline.events.map((e) => e.time), [0, 1]);
});

test('what is no recording is refused in words', () => {
  for (const text of ['', '{', '{}', '[]', 'null', '{"feeler_recording":2}']) assert.throws(() => readRecording(text), /no recording/);
  for (const text of ['{"feeler_recording":1}', '{"feeler_recording":1,"mesh":"%","frames":"%"}']) assert.throws(() => readRecording(text), /is damaged/);
});

test('samples are saved one a line', () => {
  const timeline = new Timeline();
  timeline.restart(1000);
  timeline.add(frame(2, { times: [1, 2] }));
  const lines = csvOf(timeline).trim().split('\n');
  assert.equal(lines.length, 3);
  assert.equal(lines[1].split(',').length, sampleWords);
});

test('numbers are written with three digits and the prefix that suits', () => {
  assert.deepEqual([0, 1e-6, 1.234e-3, 0.99996, 12.345, -2e-9].map((v) => withUnit(v, 'm')), ['0 m', '1 µm', '1.23 mm', '1 m', '12.3 m', '-2 nm']);
  assert.equal(withUnit(NaN, 'N'), '0 N');
});

test('the twelve types have names and are counted', () => {
  assert.equal(contactTypes.length, 13);
  assert.deepEqual(countTypes([{ type: 7 }, { type: 1 }, { type: 7 }]).map(([{ short }, n]) => [short, n]), [['V-F', 1], ['F-F', 2]]);
});

test('sticks at rest ask for nothing, and full ones for everything', () => {
  const rest = readSticks({ axes: [0.05, -0.1, 0.02, 0], buttons: [] });
  assert.ok([...rest.way, ...rest.turn].every((v) => v === 0));
  const full = readSticks({ axes: [1, -1, 0, 1], buttons: [0, 0, 0, 0, 0, 0, 0, 1].map((value) => ({ value })) });
  assert.deepEqual(full.way, [1, 1, 1]);
  assert.deepEqual(full.turn, [1, 0, 0]);
});

/** The cube from −1 to 1 about a centre; its triangles wind round outward normals, or inward ones. */
function cube({ centre = [0, 0, 0], isRoom = false, without = 0 } = {}) {
  const positions = [];
  for (let i = 0; i < 8; ++i) positions.push(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]].slice(without);
  const indices = faces.flatMap(([a, b, c, d]) => (isRoom ? [a, c, b, a, d, c] : [a, b, c, a, c, d]));
  return { centre, positions: Float32Array.from(positions), indices: Uint32Array.from(indices), faces };
}
const across = (height) => cuttingPlane([0, 0, height], [1, 0, 0], [0, 1, 0]);
const near = (a, b) => a.forEach((v, i) => assert.ok(Math.abs(v - b[i]) < 1e-9, `${a} is not ${b}`));

function area(polygon) {
  return Math.abs(polygon.reduce((sum, [u, v], i) => sum + u * polygon[(i + 1) % polygon.length][1] - v * polygon[(i + 1) % polygon.length][0], 0)) / 2;
}

test('the cut of a closed surface is a loop, and encloses what is inside', () => {
  for (const isRoom of [false, true]) {
    const square = loopsOf(cutMesh(cube({ isRoom }), across(0.3)));
    assert.equal(square.length, 1);
    assert.equal(area(square[0]), 4);
    assert.ok(square[0].every(([u, v]) => Math.max(Math.abs(u), Math.abs(v)) === 1));
    assert.deepEqual([[0, 0], [0.999, -0.999], [1.001, 0], [0, -2]].map((p) => enclose(square, p)), [true, true, false, false]);
    assert.equal(enclose([...square, square[0].map(([u, v]) => [u / 2, v / 2])], [0.1, 0.2]), false, 'a hole');
  }
  assert.deepEqual(cutMesh(cube(), across(1.5)), []);
});

test('a cut is where the centre of its mesh says, to a nanometre at a metre', () => {
  const segments = cutMesh(cube({ centre: [1e-9, 0, 5] }), cuttingPlane([-1, 0, 5.25], [1, 0, 0], [0, 1, 0]));
  const left = Math.min(...segments.map(({ from }) => from[0]));
  assert.ok(Math.abs(left - 1e-9) < 1e-15);
});

test('an open surface has a cut without loops', () => {
  const segments = cutMesh(cube({ without: 5 }), across(0.3));
  assert.equal(segments.length, 2);
  assert.equal(loopsOf(segments), null);
});

test('the cut of a tool is a polygon round its middle, at its pose', () => {
  const { positions, faces } = cube();
  const vertices = Array.from({ length: 8 }, (_, i) => [...positions.subarray(3 * i, 3 * i + 3)]);
  const turned = { position: [0, 0, 5], quaternion: [0, 0, Math.SQRT1_2, Math.SQRT1_2] };
  const polygon = cutPiece({ vertices, faces }, turned, across(5.5), 1e-3);
  assert.equal(polygon.length, 4);
  assert.ok(Math.abs(area(polygon) - 4) < 1e-12);
  near(placed(turned, [1, 0, 0]), [0, 1, 5]);
  const edge = { vertices: [[0, 0, 0], [1, 0, 0]], faces: [[0, 1]] };
  assert.equal(cutPiece(edge, { position: [0, 0, 5], quaternion: [0, 0, 0, 1] }, across(5), 1e-3).length, 2);
  near(cutPiece(edge, { position: [0, 0, 5], quaternion: [0, -Math.SQRT1_2, 0, Math.SQRT1_2] }, across(5.5), 1e-3)[0], [0, 0]);
});

test('a gap is where the tool is nearest above the wall', () => {
  const floor = (v) => ({ from: [-1, v], to: [1, v] });
  const tooth = [[0.01, 0.2], [0.5, 0.7], [-0.5, 0.7]], flat = [[-2, 0.1], [2, 0.1]];
  assert.deepEqual(gapBetween([floor(-0.1), floor(-0.2), floor(0.5)], [tooth], 1), { u: 0.01, wall: -0.1, tool: 0.2, isRight: true });
  assert.equal(gapBetween([{ from: [1, 0], to: [-1, 0] }], [tooth], 1).isRight, false);
  assert.equal(gapBetween([floor(0.5)], [tooth], 1), null, 'no wall below');
  assert.equal(gapBetween([floor(-0.1)], [tooth.map(([u, v]) => [u + 0.9, v])], 1), null, 'no tool near the middle');
  const ridge = [{ from: [-0.5, -0.4], to: [-0.03, 0] }, { from: [-0.03, 0], to: [0.5, -0.4] }];
  assert.deepEqual(gapBetween(ridge, [flat], 1), { u: -0.03, wall: 0, tool: 0.1, isRight: true });
});

test('polygons and segments are clipped to what can be seen', () => {
  assert.equal(area(clipped([[-5, -5], [5, -5], [5, 5], [-5, 5]], 1)), 4);
  assert.equal(area(clipped([[0, 0], [5, 0], [5, 5], [0, 5]], 1)), 1);
  assert.deepEqual(clipped([[2, 2], [3, 2], [3, 3]], 1), []);
  assert.deepEqual(clippedSegment([-4, 0.5], [4, 0.5], 1), [[-1, 0.5], [1, 0.5]]);
  assert.equal(clippedSegment([-4, 2], [4, 2], 1), null);
  assert.equal(clippedSegment([2, 0], [4, 0], 1), null);
});

test('colours differ from what they are drawn on: by 4.5 as words and by 3 as lines', () => {
  const channel = (v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = (hex) => [0.2126, 0.7152, 0.0722].reduce((sum, share, i) => sum + share * channel(parseInt(hex.slice(1 + 2 * i, 3 + 2 * i), 16)), 0);
  const contrast = (a, b) => (Math.max(luminance(a), luminance(b)) + 0.05) / (Math.min(luminance(a), luminance(b)) + 0.05);
  assert.ok(Math.abs(contrast('#000000', '#ffffff') - 21) < 1e-9);
  for (const palette of Object.values(palettes)) {
    for (const name of ['ink', 'faint']) assert.ok(contrast(palette[name], palette.card) >= 4.5, name);
    for (const colour of [...palette.series, palette.other]) assert.ok(contrast(colour, palette.card) >= 3, colour);
    for (const name of ['haptic', 'graphicEdge', 'force', 'torque', 'spring', 'trace', 'hapticTrace', 'edges']) {
      assert.ok(contrast(palette[name], palette.background) >= 3, name);
    }
    for (const colour of Object.values(families)) assert.ok(Math.min(contrast(colour, palette.card), contrast(colour, palette.background)) >= 3, colour);
  }
});

test('the lines of an object are its rims and sharp edges that lead somewhere', () => {
  const lines = (points, indices) => creaseLines(Float32Array.from(points.flat()), Uint32Array.from(indices)).length / 6;
  const small = 1e-5;  // [m]: no size is too small
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [1, 2, 4].map((bit) => (i & bit ? small : 0)));
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]].flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
  assert.equal(lines(corners, faces), 12, 'those of a cube, and no diagonal');
  const n = 6, at = (i, j) => i * n + j, sheet = [], flat = [];
  for (let i = 0; i < n; ++i) for (let j = 0; j < n; ++j) flat.push([i, j, 0]);
  for (let i = 0; i + 1 < n; ++i) for (let j = 0; j + 1 < n; ++j) sheet.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
  const tent = flat.map(([x, y]) => [x, y, 3 - Math.abs(x - 2)]);
  assert.equal(lines(flat, sheet), 20, 'the rim of a sheet');
  assert.equal(lines(tent, sheet), 25, 'and the ridge of a tent, from rim to rim');
  const fading = flat.map(([x, y]) => [x, y, -Math.abs(x - 2) * (0.7 - 0.12 * y)]);
  assert.equal(lines(fading, sheet), 20, 'and no ridge that ends in the middle');
});
