/** Prints criteria { what, target, measured, met }; `met` is undefined if not measured. */
export function printVerdicts(title, criteria) {
  console.log(`\n${title}`);
  const widths = ['what', 'target', 'measured'].map((key) =>
    Math.max(...criteria.map((line) => line[key].length)),
  );
  for (const { what, target, measured, met } of criteria) {
    const verdict = met === undefined ? '?' : met ? 'met' : 'MISSED';
    const cells = [what, target, measured].map((text, i) => text.padEnd(widths[i]));
    console.log(`  ${[...cells, verdict].join('  ')}`);
  }
}
