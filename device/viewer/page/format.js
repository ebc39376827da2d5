// Numbers and names as people read them.

const prefixes = [[1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p']];

/** Three digits and the prefix that suits: 0.00123 m is 1.23 mm. */
export function withUnit(value, unit, smallest = 1e-12) {
  const size = Math.abs(value);
  if (!(size >= smallest)) return `0 ${unit}`;
  const [scale, prefix] = prefixes.find(([s]) => size >= 0.9995 * s) ?? prefixes.at(-1);
  return `${Number((value / scale).toPrecision(3))} ${prefix}${unit}`;
}

/** 1 tick, 2 ticks. */
export const counted = (count, one) => `${count.toLocaleString('en')} ${one}${count === 1 ? '' : 's'}`;
export const degrees = (radians) => `${(radians * 180 / Math.PI).toFixed(2)}°`;
export const norm = ([x, y, z]) => Math.hypot(x, y, z);

/** The twelve principal contacts of Table 1 of the paper: a short name, words, and the family by which they are coloured. */
export const contactTypes = [
  null,
  { short: 'V-F', words: 'vertex on face', family: 'vertex-face' },
  { short: 'E-E', words: 'edge on convex edge', family: 'edge-edge' },
  { short: 'V-E∨', words: 'vertex in concave edge', family: 'concave' },
  { short: 'V-V∨', words: 'vertex in concave vertex', family: 'concave' },
  { short: 'E-E∨', words: 'edge in concave edge', family: 'concave' },
  { short: 'E-F', words: 'edge on face', family: 'area' },
  { short: 'F-F', words: 'face on face', family: 'area' },
  { short: 'V-E', words: 'vertex on convex edge', family: 'degenerate' },
  { short: 'V-V', words: 'vertex on convex vertex', family: 'degenerate' },
  { short: 'E-V', words: 'edge on convex vertex', family: 'degenerate' },
  { short: 'F-V', words: 'face on convex vertex', family: 'vertex-face' },
  { short: 'F-E', words: 'face on convex edge', family: 'area' },
];

/** How often each type occurs: [["V-F", 2], …]. */
export function countTypes(contacts) {
  const counts = new Map();
  for (const { type } of contacts) counts.set(type, (counts.get(type) ?? 0) + 1);
  return [...counts].sort(([a], [b]) => a - b).map(([type, count]) => [contactTypes[type], count]);
}
