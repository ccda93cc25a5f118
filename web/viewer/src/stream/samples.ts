/** One entry of samples.json, which is beside the page; addresses are relative to it. */
export interface Sample {
  readonly id: string;
  readonly title: string;
  readonly note: string;
  readonly stream: string;
  readonly bytes: number;
  /** The same surface, encoded by Draco. */
  readonly draco?: {
    readonly file: string;
    readonly bytes: number;
    readonly settings: string;
    readonly error?: number;
  };
  /** The camera's first direction: degrees around the vertical axis and above the horizon. */
  readonly orbit?: readonly [number, number];
}

/** The entries of samples.json; none if the page is served without samples. */
export async function fetchSamples(): Promise<readonly Sample[]> {
  const address = new URL('samples.json', document.baseURI);
  const response = await fetch(address);
  if (!response.ok) return [];
  const { samples } = (await response.json()) as { samples: Sample[] };
  const absolute = (file: string) => new URL(file, address).href;
  return samples.map((sample) => ({
    ...sample,
    stream: absolute(sample.stream),
    ...(sample.draco && { draco: { ...sample.draco, file: absolute(sample.draco.file) } }),
  }));
}
