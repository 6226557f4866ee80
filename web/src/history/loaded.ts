// How far back the jobs reach that the page has, in words; null: it has all that the server has. Pure.

import { clock } from '../wording';

export interface Loaded {
  /** Those that the page was told of, and since when all that ended are among them; null: since the run began. */
  told: number;
  ended_from_s: number | null;
  /** Those that were fetched besides, and whether there may be more. */
  fetched: number;
  is_all: boolean;
}

export function loaded_in_words({ told, ended_from_s, fetched, is_all }: Loaded): string | null {
  if (is_all) return null;
  const rest = 'are not loaded, and the filter does not look at them.';
  if (fetched > 0) return `The last ${told + fetched} are loaded. Earlier ones ${rest}`;
  if (ended_from_s === null) return `All of this run of the server are loaded. Those of former runs ${rest}`;
  return `Those that ended since ${clock(ended_from_s)} are loaded. Earlier ones ${rest}`;
}
