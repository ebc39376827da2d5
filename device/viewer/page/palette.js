// The colours of both themes, for the scene and the strips; style.css has those of the page.

export const palettes = {
  light: {
    background: '#eef1f4', object: '#d8c9b4', inner: '#c2a98c', edges: '#6f6252', haptic: '#d62f2a', graphic: '#8d97a3', graphicEdge: '#39424d',
    force: '#c25700', torque: '#7a3fb8', spring: '#a8201c', trace: '#2b6cb0', hapticTrace: '#d98a86', ink: '#1f2730', faint: '#6a7683', grid: '#d5dbe1',
    series: ['#b23a00', '#0f62a8', '#2b7a3d', '#7a3fb8'], other: '#0b7285',
  },
  dark: {
    background: '#14181d', object: '#a4917a', inner: '#7d6a54', edges: '#8d7b63', haptic: '#ff5a52', graphic: '#aab4c0', graphicEdge: '#e3e8ee',
    force: '#ffa24d', torque: '#c69bff', spring: '#ff8a83', trace: '#6db3ff', hapticTrace: '#a2605d', ink: '#e6ebf0', faint: '#9aa6b2', grid: '#2b333c',
    series: ['#ff9d57', '#6db3ff', '#7fd394', '#c69bff'], other: '#4dd0e1',
  },
};

/** Of contacts, by their family; readable on both themes. */
export const families = {
  'vertex-face': '#0a9396', 'edge-edge': '#e09f1f', area: '#3f9b47', concave: '#8250df', degenerate: '#d6409f',
};
