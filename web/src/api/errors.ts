/** The same list as the C++ `isostar::Error`. */
export type IsostarErrorCode =
  'BadArgument' | 'NotIsostar' | 'UnsupportedVersion' | 'Truncated' | 'Corrupt' | 'OverLimit';

export class IsostarError extends Error {
  override readonly name = 'IsostarError';

  constructor(
    readonly code: IsostarErrorCode,
    message: string,
  ) {
    super(message);
  }
}
