import type { Polygonizer } from 'isostar';
import { fromAddress, fromFile } from './stream/download.ts';
import { fetchSamples, type Sample } from './stream/samples.ts';
import { Viewer } from './viewer.ts';

const element = <E extends HTMLElement>(selector: string): E =>
  document.querySelector<E>(selector)!;
const query = new URLSearchParams(location.search);

const viewer = new Viewer();
const samples = await fetchSamples();
listenToControls();
acceptFiles();
const first = samples.find(({ id }) => id === query.get('sample')) ?? samples[0];
if (first) play(first);
else
  viewer.showMessage(
    'There are no samples beside this page. Open an .isostar file, or drop one here.',
  );

function play(sample: Sample): void {
  element<HTMLSelectElement>('#sample').value = sample.id;
  void viewer.play(fromAddress(sample.stream), sample);
}

function listenToControls(): void {
  const picker = element<HTMLSelectElement>('#sample');
  picker.replaceChildren(...samples.map(({ id, title }) => new Option(title, id)));
  picker.addEventListener('change', () => play(samples[picker.selectedIndex]!));

  const rates = element('#rate');
  const wanted = rates.querySelector<HTMLInputElement>(`input[value="${query.get('rate') ?? 5}"]`);
  if (wanted) wanted.checked = true;
  const rate = () =>
    viewer.setRate(1e6 * Number(rates.querySelector<HTMLInputElement>(':checked')!.value));
  rate();
  rates.addEventListener('change', () => {
    rate();
    void viewer.replay();
  });

  element('#polygonizer').addEventListener('change', ({ target }) =>
    viewer.setPolygonizer((target as HTMLInputElement).value as Polygonizer),
  );
  element('#replay').addEventListener('click', () => void viewer.replay());
  element('#fit').addEventListener('click', () => viewer.stage.fit());
  onToggle('#wireframe', (on) => viewer.stage.setWireframe(on));
  onToggle('#chunks', (on) => viewer.stage.setColouring(on));
  onToggle('#compare', (on) => viewer.setComparing(on));
  addEventListener('keydown', handleKey);
}

function onToggle(selector: string, set: (on: boolean) => void): void {
  const button = element(selector);
  button.addEventListener('click', () => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', String(on));
    set(on);
  });
}

function handleKey(event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLSelectElement)
    return;
  const buttons: Record<string, string> = {
    f: '#fit',
    w: '#wireframe',
    k: '#chunks',
    c: '#compare',
    r: '#replay',
  };
  const button = buttons[event.key.toLowerCase()];
  if (button) element(button).click();
}

function acceptFiles(): void {
  const input = element<HTMLInputElement>('#file');
  element('#open').addEventListener('click', () => input.click());
  input.addEventListener('change', () => show(input.files?.[0]));

  const hint = element('#drop');
  addEventListener('dragover', (event) => {
    event.preventDefault();
    hint.hidden = false;
  });
  addEventListener('dragleave', (event) => (hint.hidden = event.relatedTarget !== null));
  addEventListener('drop', (event) => {
    event.preventDefault();
    hint.hidden = true;
    show(event.dataTransfer?.files[0]);
  });
}

function show(file: File | undefined): void {
  if (!file) return;
  element<HTMLSelectElement>('#sample').selectedIndex = -1;
  void viewer.play(fromFile(file));
}
