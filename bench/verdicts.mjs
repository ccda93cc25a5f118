/** Prints criteria { what, target, measured, met } under a title; met is undefined where nothing was measured. */
export function printVerdicts(title, criteria) {
  console.log(`\n${title}`);
  const widths = ['what', 'target', 'measured'].map((key) => Math.max(...criteria.map((line) => line[key].length)));
  for (const { what, target, measured, met } of criteria) {
    const verdict = met === undefined ? '?' : met ? 'met' : 'MISSED';
    console.log(`  ${what.padEnd(widths[0])}  ${target.padEnd(widths[1])}  ${measured.padEnd(widths[2])}  ${verdict}`);
  }
}
