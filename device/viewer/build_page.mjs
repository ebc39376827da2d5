// Bundles the modules of page/ and three.js into one HTML file that needs nothing else.
// usage: node build_page.mjs output.html
import { readFile, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const page = join(dirname(fileURLToPath(import.meta.url)), 'page');

async function bundled(entry) {
  const result = await build({
    entryPoints: [join(page, entry)], bundle: true, minify: true, write: false, format: 'esm', target: 'es2022',
    charset: 'utf8', legalComments: 'inline',
  });
  return result.outputFiles[0].text;
}

// Whatever a script says, its element ends where the HTML says.
const inElement = (text) => text.replaceAll('</script', '<\\/script');

const [html, script, style] = await Promise.all([readFile(join(page, 'index.html'), 'utf8'), bundled('main.js'), bundled('style.css')]);
const whole = html
  .replace('<link rel="stylesheet" href="style.css">', () => `<style>${style}</style>`)
  .replace('<script type="module" src="main.js"></script>', () => `<script type="module">${inElement(script)}</script>`);
await writeFile(process.argv[2], whole);
