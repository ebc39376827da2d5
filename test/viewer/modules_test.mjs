// The modules of the page that need no browser: the wire, the timeline, recordings, numbers, sticks.
// usage: node --test modules_test.mjs
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { contactTypes, countTypes, withUnit } from '../../device/viewer/page/format.js';
import { readSticks } from '../../device/viewer/page/gamepad.js';
import { readFrameAt, readMessage, sampleColumns, sampleWords } from '../../device/viewer/page/protocol.js';
import { readRecording, writeRecording } from '../../device/viewer/page/recording.js';
import { csvOf } from '../../device/viewer/page/save.js';
import { countTicks } from '../../device/viewer/page/strips.js';
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

test('ticks, missed deadlines and converged ones are counted', () => {
  const timeline = new Timeline();
  timeline.restart(1000);
  timeline.add(frame(0.003, { times: [0.001, 0.002, 0.003], missed: 2 }));
  timeline.add(frame(0.005, { times: [0.005], flags: 0 }));
  assert.deepEqual(countTicks(timeline.samples, 0.002, 1), { ticks: 3, missed: 4, converged: 2 });
});

test('a recording that is written is read again', () => {
  const stage = { stage: 3, title: 'x' };
  const text = writeRecording(stage, meshBuffer(), [frame(1), frame(2, { type: 2, times: [1.5, 2] }), frame(3, { stage: 4 })]);
  const { mesh, timeline, stage: read } = readRecording(text);
  assert.deepEqual(read, stage);
  assert.equal(mesh.positions.length, 9);
  assert.deepEqual(timeline.frames.map((f) => f.time), [1, 2]);
  assert.equal(timeline.samples.count, 3);
  assert.deepEqual(timeline.events.map((e) => e.time), [1, 2]);
});

test('what is no recording is refused in words', () => {
  for (const text of ['', '{', '{}', '[]', 'null', '{"feeler_recording":2}']) assert.throws(() => readRecording(text), /no recording/);
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
