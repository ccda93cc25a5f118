// Numbers and tables in Markdown.

export const fixed = (number, digits) =>
  number === undefined || !Number.isFinite(number) ? '–' : number.toFixed(digits);
export const times = (number) => (number === undefined ? '–' : `${fixed(number, 2)}×`);
export const kilobytes = (bytes) =>
  bytes === undefined ? '–' : `${(bytes / 1000).toFixed(bytes < 1e5 ? 1 : 0)}`;
export const significant = (number) =>
  number === null || number === undefined ? '–' : number.toPrecision(2);

/**
 * Columns are pairs of a heading and a function from row to cell; all but the first are numbers.
 */
export function table(rows, columns) {
  const line = (cells) => `| ${cells.join(' | ')} |`;
  return [
    line(columns.map(([heading]) => heading)),
    `|${columns.map((_, i) => (i === 0 ? '---' : '---:')).join('|')}|`,
    ...rows.map((row) => line(columns.map(([, cell]) => cell(row)))),
  ].join('\n');
}
