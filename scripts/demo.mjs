// `npm run demo`, after set-up and build: encodes the samples and serves the viewer, at PORT and
// HOST, by default 8080 on localhost.
import { fileURLToPath } from 'node:url';
import { makeSamples } from './sample-scans.mjs';
import { serve } from './serve.mjs';

const inBuild = (path) => fileURLToPath(new URL(`../build/${path}`, import.meta.url));
const host = process.env.HOST ?? '127.0.0.1';

makeSamples(inBuild('isostar'), inBuild('samples'), inBuild('scans'));
const folders = [inBuild('viewer'), inBuild('samples')];
const port = Number(process.env.PORT ?? 8080);
const { address } = await serve(folders, { port, host }).catch((reason) => {
  if (reason.code !== 'EADDRINUSE' || process.env.PORT) throw reason;
  return serve(folders, { host });
});
console.log(`\nThe viewer is at ${address} (Ctrl-C stops it)`);
