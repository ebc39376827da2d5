// The colours of both themes, for the scene and the strips; style.css has those of the page.

export const palettes = {
  light: {
    background: '#eef1f4', card: '#ffffff', object: '#d8c9b4', inner: '#c2a98c', edges: '#6f6252', haptic: '#d62f2a', graphic: '#8d97a3', graphicEdge: '#39424d',
    force: '#b34f00', torque: '#7a3fb8', spring: '#a8201c', trace: '#2b6cb0', hapticTrace: '#c0605b', ink: '#1f2730', faint: '#55616d', grid: '#d5dbe1',
    series: ['#b23a00', '#0f62a8', '#2b7a3d', '#7a3fb8'], other: '#0b7285',
  },
  dark: {
    background: '#14181d', card: '#1c2229', object: '#6a5c4b', inner: '#52463a', edges: '#a8957c', haptic: '#ff5a52', graphic: '#aab4c0', graphicEdge: '#e3e8ee',
    force: '#ffa24d', torque: '#c69bff', spring: '#ff8a83', trace: '#6db3ff', hapticTrace: '#c07a76', ink: '#e6ebf0', faint: '#a5b1bd', grid: '#2b333c',
    series: ['#ff9d57', '#6db3ff', '#7fd394', '#c69bff'], other: '#4dd0e1',
  },
};

/** Of contacts, by their family; readable on both themes. */
export const families = {
  'vertex-face': '#0a9396', 'edge-edge': '#b87400', area: '#3f9b47', concave: '#8250df', degenerate: '#d6409f',
};
