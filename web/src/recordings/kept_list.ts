// The list of the server's recordings, as last fetched.

import { signal } from '@preact/signals';
import type { Api } from '../server/api';
import type { KeptRecording, RecordingList } from '../server/messages';
import { wall_time } from '../wall_time';
import { of_server, type Source } from './sources';
import type { Sources } from './player';

export class KeptList {
  /** The list, or null if not fetched yet. */
  readonly list = signal<RecordingList | null>(null);
  /** Why the last fetch failed, or null. */
  readonly fault = signal<string | null>(null);

  constructor(private readonly api_: Pick<Api, 'recordings' | 'recording_address'>) {}

  async look(): Promise<void> {
    const answer = await this.api_.recordings();
    this.fault.value = answer.ok ? null : answer.problem.detail ?? answer.problem.title;
    if (answer.ok) this.list.value = answer.value;
  }

  address_of({ name }: KeptRecording, file: string): string {
    return this.api_.recording_address(name, file);
  }

  /** Returns the sources for opening a recording. */
  sources_of(recording: KeptRecording): Sources {
    const source = (name: string): Source | null => {
      const file = recording.files.find((known) => known.name === name);
      return file ? of_server(this.address_of(recording, name), file.bytes, (url, init) => fetch(url, init)) : null;
    };
    return { states: source('states.csv'), events: source('events.jsonl') };
  }
}

/** Returns the title: the time at which the recording began. */
export function title_of_recording({ name, begun_at }: Pick<KeptRecording, 'name' | 'begun_at'>): string {
  return begun_at === null ? name : wall_time(begun_at);
}

/** Returns how long the recording is, or null if unknown. */
export function length_s_of({ begun_at, written_at }: Pick<KeptRecording, 'begun_at' | 'written_at'>): number | null {
  const length_s = begun_at === null ? NaN : (Date.parse(written_at) - Date.parse(begun_at)) / 1000;
  return Number.isFinite(length_s) && length_s >= 0 ? length_s : null;
}
