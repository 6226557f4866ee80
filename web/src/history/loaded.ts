// Describes how far back the loaded jobs reach. Returns null if all jobs of the server are loaded.
// Pure.

import { kText } from '../strings';
import { clock } from '../wording';

export interface Loaded {
  /**
   * The number of jobs received as events. They are complete since `ended_from_s`; null means since
   * the session began.
   */
  received: number;
  ended_from_s: number | null;
  /** The number of jobs loaded in addition. `is_all` is true if the server has no others. */
  fetched: number;
  is_all: boolean;
}

export function loaded_in_words({ received, ended_from_s, fetched, is_all }: Loaded): string | null {
  if (is_all) return null;
  if (fetched > 0) return kText.history.last_loaded(received + fetched);
  if (ended_from_s === null) return kText.history.session_loaded;
  return kText.history.loaded_since(clock(ended_from_s));
}
