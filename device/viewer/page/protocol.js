// Reads the binary messages of the server: frames and meshes. device/viewer/src/wire.cpp writes them.

export const wireVersion = 1;
const kinds = { frame: 1, mesh: 2 };

const frameHead = 34, contactWords = 9;
export const frameTime = 4;  // where a frame has its time
export const sampleWords = 15;

/** Columns of a sample, in the order of the wire. SI units; times of computation in microseconds. */
export const sampleColumns = [
  'time', 'fx', 'fy', 'fz', 'tx', 'ty', 'tz', 'offset', 'turn', 'compute_us', 'late_us', 'contacts', 'iterations', 'missed', 'flags',
];
export const sampleIndex = Object.fromEntries(sampleColumns.map((name, i) => [name, i]));
export const flags = { converged: 1, folded: 2 };

export const handModes = ['still', 'motion', 'person', 'device'];
export const statuses = ['converged', 'unconverged', 'unverified', 'penetrating', 'not finite', 'not reset'];

/** Seven numbers of the wire as a pose: position [m] and quaternion x, y, z, w as three.js has it. */
export function poseAt(words, at) {
  return {
    position: [words[at], words[at + 1], words[at + 2]],
    quaternion: [words[at + 4], words[at + 5], words[at + 6], words[at + 3]],
  };
}

function readContact(words, at) {
  return {
    type: words[at], point: [words[at + 1], words[at + 2], words[at + 3]], normal: [words[at + 4], words[at + 5], words[at + 6]],
    gap: words[at + 7], force: words[at + 8],
  };
}

function readFrame(words) {
  const contactCount = words[32], sampleCount = words[33];
  const contacts = [];
  for (let i = 0; i < contactCount; ++i) contacts.push(readContact(words, frameHead + contactWords * i));
  const begin = frameHead + contactWords * contactCount;
  return {
    kind: 'frame', stage: words[2], tick: words[3], time: words[frameTime], mode: handModes[words[5]], haptic: poseAt(words, 6), graphic: poseAt(words, 13),
    force: Array.from(words.subarray(20, 23)), torque: Array.from(words.subarray(23, 26)), status: statuses[words[26]], iterations: words[27],
    rows: words[28], work: words[29], missed: words[30], lost: words[31],
    contacts: contacts.filter((c) => c.type > 0), holding: contacts.filter((c) => c.type === 0),
    samples: words.subarray(begin, begin + sampleWords * sampleCount), words,
  };
}

/** A frame within a longer list of words, and where it ends. @throws Error where the list is cut off */
export function readFrameAt(words, at) {
  const end = at + frameHead + contactWords * words[at + 32] + sampleWords * words[at + 33];
  if (words[at] !== wireVersion || words[at + 1] !== kinds.frame || !(end <= words.length)) throw new Error('The recording is damaged: record it again.');
  return { frame: readFrame(words.subarray(at, end)), end };
}

function readMesh(buffer, words) {
  const vertexCount = words[6], triangleCount = words[7];
  const begin = 8 * 8;
  return {
    kind: 'mesh', stage: words[2], buffer, centre: [words[3], words[4], words[5]],
    positions: new Float32Array(buffer, begin, 3 * vertexCount),
    indices: new Uint32Array(buffer, begin + 12 * vertexCount, 3 * triangleCount),
  };
}

/** @throws Error with a sentence where the message is of another version or kind */
export function readMessage(buffer) {
  const words = new Float64Array(buffer, 0, Math.floor(buffer.byteLength / 8));
  if (words[0] !== wireVersion) throw new Error('The server speaks another version than this page: load the page again.');
  if (words[1] === kinds.frame) return readFrame(words);
  if (words[1] === kinds.mesh) return readMesh(buffer, words);
  throw new Error('The server sent a message of an unknown kind.');
}
