// planck's time of impact from pose to pose, as a worker that answers as query_rival.py does:
// node query_planck.mjs SLOP, the tolerance of contacts in metres; nothing for planck's own, 5 mm.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';

const require = createRequire(process.cwd() + '/');
const planck = require('planck');
if (process.argv[2]) planck.Settings.linearSlop = Number(process.argv[2]);
const { TOIInput, TOIOutput, TOIOutputState, TimeOfImpact } = planck;

function ask(one, other, half, poses, count) {
  const input = new TOIInput();
  const output = new TOIOutput();
  input.proxyA.set(new planck.Box(one, half), 0);
  input.proxyB.set(new planck.Box(other, half), 0);
  input.tMax = 1;
  const began = process.cpuUsage();
  let told = null;
  for (let n = 0; n + 1 < count; n++) {
    for (const [sweep, k] of [[input.sweepA, 6 * n], [input.sweepB, 6 * n + 3]]) {
      sweep.c0.set(poses[k], poses[k + 1]);
      sweep.c.set(poses[k + 6], poses[k + 7]);
      sweep.a0 = poses[k + 2];
      sweep.a = poses[k + 8];
      sweep.alpha0 = 0;
      sweep.localCenter.setZero();
    }
    TimeOfImpact(output, input);
    if (output.state === TOIOutputState.e_touching || output.state === TOIOutputState.e_overlapped) {
      told = n + output.t;
      break;
    }
  }
  const { user, system } = process.cpuUsage(began);
  return [(user + system) / 1e6, told];
}

for await (const line of createInterface({ input: process.stdin })) {
  const bytes = readFileSync(line.trim());
  const numbers = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const told = [];
  for (let at = 0; at < numbers.length;) {
    const [count, one, other, half] = numbers.subarray(at, at + 4);
    told.push(ask(one, other, half, numbers.subarray(at + 4, at + 4 + 6 * count), count));
    at += 4 + 6 * count;
  }
  console.log(JSON.stringify(told));
}
