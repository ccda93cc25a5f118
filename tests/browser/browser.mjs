// Chromium, a server for the built viewer and for a test's own files, and helpers to inspect a
// page.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { serve } from '../../scripts/serve.mjs';

const ARGUMENTS = [
  '--no-sandbox',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  // WebGL without a graphics card:
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
];
export const VIEWER = fileURLToPath(new URL('../../build/viewer', import.meta.url));

/**
 * Serves `folders` and opens pages; `close` ends both, and fails if a page or worker requested
 * anything from elsewhere. `complaints` collects the errors and warnings of all pages.
 */
export async function openBrowser(folders, options) {
  const profile = mkdtempSync(join(tmpdir(), 'isostar-browser-'));
  const { server, address } = await serve(folders, options);
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: '/usr/bin/chromium',
    headless: true,
    args: ARGUMENTS,
    viewport: { width: 1000, height: 700 },
  });
  const complaints = [];
  const requestsElsewhere = [];
  context.on('request', (request) => {
    if (!request.url().startsWith(address) && !isLocal(request.url()))
      requestsElsewhere.push(request.url());
  });
  return {
    address,
    complaints,
    async open(path) {
      const page = await context.newPage();
      page.on('console', (message) => isComplaint(message) && complaints.push(message.text()));
      page.on('pageerror', (error) => complaints.push(String(error)));
      page.on('requestfailed', (request) => {
        const text = request.failure()?.errorText ?? '';
        // The page itself aborted that one.
        if (text !== 'net::ERR_ABORTED') complaints.push(`${request.url()} ${text}`);
      });
      await page.goto(address + path);
      return page;
    },
    async close() {
      await context.close();
      server.closeAllConnections();
      server.close();
      rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
      assert.deepEqual(requestsElsewhere, []);
    },
  };
}

/** Addresses for which a page opens no connection. */
const isLocal = (url) => /^(data|blob|about):/.test(url);

/** Chromium's own warnings about its software renderer do not count. */
const isComplaint = (message) =>
  ['error', 'warning'].includes(message.type()) &&
  !/GPU stall|GL Driver Message|software WebGL/i.test(message.text());

/** The number of colours, of five bits per channel, in a screenshot of the element. */
export async function coloursOf(page, selector) {
  const picture = await page.locator(selector).screenshot();
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) {
      const [red, green, blue] = [data[i] >> 3, data[i + 1] >> 3, data[i + 2] >> 3];
      colours.add((red << 10) | (green << 5) | blue);
    }
    return colours.size;
  }, picture.toString('base64'));
}
