// Finds what the address selects (jobs, arms, an object). All views highlight the selection.

import { job_of_side } from '../diagram/sides';
import type { Store } from '../state/store';
import { object_of } from '../wording';
import type { Place } from './address';

export interface Selection { jobs: readonly string[]; arms: readonly string[]; object: string | null }

export const kNothing: Selection = { jobs: [], arms: [], object: null };

export function selection_of(place: Place, store: Store): Selection {
  const arms_of = (id: string) => store.job(id)?.arms ?? [];
  switch (place.page) {
    case 'job': {
      const job = store.job(place.id);
      return { jobs: [place.id], arms: job?.arms ?? [], object: job ? object_of(job) : null };
    }
    case 'pair': {
      const jobs = [place.a, place.b].map((side) => job_of_side(side, store)?.id ?? side);
      return { jobs, arms: jobs.flatMap(arms_of), object: null };
    }
    case 'arm': return { jobs: [], arms: [place.name], object: null };
    case 'scene': return { jobs: [], arms: [], object: place.name };
    default: return kNothing;
  }
}
