// Recordings: a stage, its mesh and its frames in one JSON document. device/demo/live/report_player.cpp writes the same.
import { frameTime, readFrameAt, readMessage, sampleIndex, sampleWords } from './protocol.js';
import { Timeline } from './timeline.js';

const version = 1;

function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

function base64Of(buffer) {
  const bytes = new Uint8Array(buffer), piece = 0x8000;
  let text = '';
  for (let i = 0; i < bytes.length; i += piece) text += String.fromCharCode(...bytes.subarray(i, i + piece));
  return btoa(text);
}

const damaged = 'The recording is damaged: record it again.';

/** The binary parts of a document. @throws Error with a sentence where they are none */
function partsOf({ stage, mesh, frames }) {
  try {
    const scene = readMessage(bytesOf(mesh)), words = Float64Array.from(new Float32Array(bytesOf(frames)));
    if (scene.kind === 'mesh' && typeof stage.title === 'string' && Array.isArray(stage.tool)) return { scene, words };
  } catch { /* whatever is wrong with it */ }
  throw new Error(damaged);
}

/** @return {stage, mesh, timeline}  @throws Error with a sentence where the text is no recording */
export function readRecording(text) {
  let document;
  try {
    document = JSON.parse(text);
  } catch {
    throw new Error('This file is no recording of Feeler: choose replay.json of a report.');
  }
  if (document?.feeler_recording !== version) throw new Error('This file is no recording of this version of Feeler: record it again.');
  const { scene, words } = partsOf(document);
  const frames = [];
  let sampleCount = 0;
  for (let at = 0; at < words.length;) {
    const { frame, end } = readFrameAt(words, at);
    frames.push(frame);
    sampleCount += frame.samples.length / sampleWords;
    at = end;
  }
  if (frames.length === 0) throw new Error('This recording is empty: record it again.');
  const timeline = new Timeline(Math.max(sampleCount, 1));
  let types = '';
  for (const frame of frames) {
    timeline.add(frame, true);
    const now = frame.contacts.map((c) => c.type).join();
    if (now !== types) timeline.addEvent(frame.time, 'switch');
    types = now;
  }
  return { stage: document.stage, mesh: scene, timeline };
}

/** Of a live view: the frames that are kept, of the stage on show. Its time begins at 0, so that two recordings run together. */
export function writeRecording(stage, meshBuffer, frames) {
  const kept = frames.filter((frame) => frame.stage === stage.stage);
  const all = new Float32Array(kept.reduce((sum, { words }) => sum + words.length, 0));
  const begin = kept[0]?.samples[sampleIndex.time] ?? kept[0]?.time;
  let at = 0;
  for (const { words, samples, time } of kept) {
    all.set(words, at);
    all[at + frameTime] = time - begin;
    at += words.length;
    for (let i = sampleIndex.time; i < samples.length; i += sampleWords) all[at - samples.length + i] = samples[i] - begin;
  }
  return JSON.stringify({ feeler_recording: version, stage, mesh: base64Of(meshBuffer), frames: base64Of(all.buffer) });
}
