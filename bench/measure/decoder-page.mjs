// A page with the package, beside a stream to be measured.
import { copyFileSync } from 'node:fs';
import { join } from 'node:path';
import { openBrowser } from '../../tests/browser/browser.mjs';
import { makePage } from '../../tests/browser/package-page.mjs';

/** Opens a page with `createDecoder`; the stream is at /measured.isostar. */
export async function openDecoderPage(stream) {
  const folder = await makePage();
  copyFileSync(stream, join(folder, 'measured.isostar'));
  const browser = await openBrowser([folder]);
  const page = await browser.open('page/');
  await page.waitForFunction(() => window.createDecoder);
  return { browser, page };
}
