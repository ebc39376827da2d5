// A running feeler-demo, and a headless Chromium that draws as one on a machine without a graphics processor.
import { spawn } from 'node:child_process';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

export class LiveDemo {
  /** Returns when it has said where it serves, or has ended. */
  static async start(program, ...options) {
    const demo = new LiveDemo();
    const { DISPLAY: _, WAYLAND_DISPLAY: __, ...environment } = process.env;  // so that no other browser opens
    demo.child = spawn(program, options, { stdio: ['ignore', 'pipe', 'pipe'], env: environment });
    demo.output = '';
    demo.errors = '';
    demo.child.stdout.on('data', (text) => (demo.output += text));
    demo.child.stderr.on('data', (text) => (demo.errors += text));
    demo.ended = new Promise((resolve) => demo.child.on('close', resolve));
    await until(() => /https?:\S+\n/.test(demo.output) || demo.child.exitCode !== null, 'the address');
    demo.url = demo.output.match(/http:\S+/)?.[0];
    return demo;
  }

  async stop() {
    this.child.kill('SIGINT');
    return this.ended;
  }
}

export async function until(condition, what, milliseconds = 30000) {
  const end = Date.now() + milliseconds;
  while (!(await condition())) {
    if (Date.now() > end) throw new Error(`waited in vain for ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** @param modules  folder with playwright-core */
export async function startBrowser(modules, chromiumPath, ...more) {
  const playwright = await import(pathToFileURL(join(modules, 'playwright-core', 'index.mjs')));
  const { chromium } = playwright.default ?? playwright;
  return chromium.launch({ executablePath: chromiumPath, args: ['--no-sandbox', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage', ...more] });
}
