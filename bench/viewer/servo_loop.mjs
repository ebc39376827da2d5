// Whether pages disturb the servo loop: the same seconds of it with nobody watching and with ten watchers, in turns.
// usage: node servo_loop.mjs feeler-demo [rounds] [seconds a round] [pages] [option of feeler-demo …]
import { request } from 'node:http';
import os from 'node:os';
import { LiveDemo } from '../../test/viewer/live_demo.mjs';

const [program, rounds = '3', seconds = '20', pages = '10', ...options] = process.argv.slice(2);
const scene = options.length > 0 ? options : ['--scene', 'spline'];

/** A page that reads all it is told and draws nothing: the same to the server. @return how to ask how many bytes it has read */
function watch(url) {
  let bytes = 0;
  const { host, hostname, port } = new URL(url);
  const headers = { Host: host, Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': 'AAAAAAAAAAAAAAAAAAAAAA==' };
  const upgrade = request({ host: hostname, port, path: '/live', headers });
  upgrade.on('upgrade', (_, socket, head) => {
    bytes += head.length;
    socket.on('data', (data) => (bytes += data.length));
    socket.on('error', () => {});
  });
  upgrade.on('error', () => {});
  upgrade.end();
  return () => bytes;
}

/** Of one run: the figures that the demo prints at its end. */
async function run(watchers) {
  const demo = await LiveDemo.start(program, '--view', '--play', '--port', '0', '--seconds', seconds, ...scene);
  const readers = Array.from({ length: watchers }, () => watch(demo.url));
  const code = await demo.ended;
  const number = (pattern) => Number(demo.output.match(pattern)?.[1] ?? NaN);
  const tail = (name) => ['median', 'p99', 'p99.9', 'max'].map((share) => number(new RegExp(`${name} \\[us\\]:.*?${share.replace('.', '\\.')} ([\\d.e+]+)`)));
  if (code !== 0) throw new Error(`feeler-demo ends with ${code}: ${demo.errors}`);
  return {
    watchers, bytes: readers.reduce((sum, read) => sum + read(), 0), ticks: number(/ticks: (\d+)/), missed: number(/missed deadlines: (\d+)/),
    late: tail('wake-up latency'), time: tail('compute time'),
  };
}

const middle = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
const row = (cells) => console.log(`| ${cells.join(' | ')} |`);

const results = [];
console.log(`${os.cpus().length} processors, ${os.cpus()[0].model}, ${os.release()}; rounds of ${seconds} s of ${scene.join(' ')}`);
row(['round', 'pages', 'MB read', 'load', 'missed', 'lateness, median / p99 / p99.9 / max µs', 'time of a tick, median / p99 / p99.9 / max µs']);
row(Array(7).fill('---'));
for (let round = 1; round <= Number(rounds); ++round) {
  const both = [0, Number(pages)];
  for (const watchers of round % 2 === 1 ? both : both.reverse()) {  // neither is always the first
    const result = await run(watchers);
    results.push(result);
    row([round, watchers, (result.bytes / 1e6).toFixed(1), os.loadavg()[0].toFixed(1), `${result.missed} of ${result.ticks}`, result.late.join(' / '), result.time.join(' / ')]);
  }
}
for (const watchers of [0, Number(pages)]) {
  const those = results.filter((result) => result.watchers === watchers);
  const sum = (of) => those.reduce((total, result) => total + of(result), 0);
  const tails = (name) => [0, 1, 2, 3].map((i) => middle(those.map((result) => result[name][i]))).join(' / ');
  row(['middle', watchers, (sum(({ bytes }) => bytes) / those.length / 1e6).toFixed(1), '', `${sum(({ missed }) => missed)} of ${sum(({ ticks }) => ticks)}`, tails('late'), tails('time')]);
}
