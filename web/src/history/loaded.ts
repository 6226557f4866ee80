// How far back the jobs reach that the page has, in words; null: it has all that the server has. Pure.

import { kText } from '../strings';
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
  if (fetched > 0) return kText.history.last_loaded(told + fetched);
  if (ended_from_s === null) return kText.history.session_loaded;
  return kText.history.loaded_since(clock(ended_from_s));
}
