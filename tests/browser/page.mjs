// A real browser, a server for the built viewer and for the test's own files, and what is needed to look at a page.
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { serve } from '../../scripts/serve.mjs';

const ARGUMENTS = [
  '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',  // WebGL without a graphics card
];
export const VIEWER = fileURLToPath(new URL('../../build/viewer', import.meta.url));

/** Serves `folders` and opens pages; `close` ends both. `complaints` collects what any page reports to its console. */
export async function openBrowser(folders, options) {
  const profile = mkdtempSync(join(tmpdir(), 'isostar-browser-'));
  const { server, address } = await serve(folders, options);
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: '/usr/bin/chromium', headless: true, args: ARGUMENTS, viewport: { width: 1000, height: 700 },
  });
  const complaints = [];
  return {
    address,
    complaints,
    async open(path) {
      const page = await context.newPage();
      page.on('console', (message) => ['error', 'warning'].includes(message.type()) && isOurs(message) && complaints.push(message.text()));
      page.on('pageerror', (error) => complaints.push(String(error)));
      page.on('requestfailed', (request) => {
        const text = request.failure()?.errorText ?? '';
        if (text !== 'net::ERR_ABORTED') complaints.push(`${request.url()} ${text}`);  // the page itself gave that one up
      });
      await page.goto(address + path);
      return page;
    },
    async close() {
      await context.close();
      server.closeAllConnections();
      server.close();
      rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
    },
  };
}

// The software renderer says so itself, as a warning of slowness.
const isOurs = (message) => !/GPU stall|GL Driver Message|software WebGL/i.test(message.text());

/** How many colours a screenshot of the element has, more or less: one or two when nothing is drawn. */
export async function coloursOf(page, selector) {
  const picture = await page.locator(selector).screenshot();
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) colours.add((data[i] >> 3 << 10) | (data[i + 1] >> 3 << 5) | (data[i + 2] >> 3));
    return colours.size;
  }, picture.toString('base64'));
}
