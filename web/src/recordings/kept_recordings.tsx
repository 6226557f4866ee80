// What this server has recorded: each is opened here, or its files are taken away.

import { useEffect, useState } from 'preact/hooks';
import type { KeptRecording } from '../server/messages';
import type { App } from '../state/app';
import { short_wall_time, wall_time } from '../wall_time';
import { bytes_in_words, seconds } from '../wording';
import { length_s_of, title_of_recording } from './kept_list';

const kShown = 10;

export function KeptRecordings({ app }: { app: App }) {
  const { kept } = app;
  const { stream } = app.store;
  const [shown, set_shown] = useState(kShown);
  useEffect(() => { void kept.look(); }, [kept, stream]);
  const list = kept.list.value;
  const fault = kept.fault.value;
  return (
    <>
      <h3>On this server {list?.kept && <span class="count">{list.recordings.length}</span>}<span class="spacer" />
        {list?.kept && <button class="small" data-test="recordings-again" onClick={() => void kept.look()}>Look again</button>}</h3>
      {fault !== null && <p class="refused" role="alert">The list cannot be had: {fault}</p>}
      {list && !list.kept && <p class="hint" data-test="not-kept">This server records nothing: <code>armloom serve --data DIR</code> writes down each run, with <code>--record</code> the arms' positions, too.</p>}
      {list?.kept && (
        <ul class="kept" data-test="kept-recordings">
          {list.recordings.slice(0, shown).map((recording) => <Kept key={recording.name} app={app} recording={recording} />)}
        </ul>
      )}
      {list && list.recordings.length > shown && <button class="small" onClick={() => set_shown(shown + 5 * kShown)}>{list.recordings.length - shown} earlier ones</button>}
    </>
  );
}

function Kept({ app, recording }: { app: App; recording: KeptRecording }) {
  const { begun_at, written_at, running, has_states, files } = recording;
  const sources = app.kept.sources_of(recording);
  const bytes = (sources.states?.bytes ?? 0) + (sources.events?.bytes ?? 0);
  const length_s = length_s_of(recording);
  const title = title_of_recording(recording);
  return (
    <li data-test={`recording-${recording.name}`}>
      <div class="line">
        <b class="mono" title={begun_at === null ? '' : wall_time(begun_at)}>{begun_at === null ? recording.name : short_wall_time(begun_at, Date.now())}</b>
        <span class="spacer" />
        <button class="small" data-test="open-recording" disabled={app.player.reading.value !== null} aria-label={`Open the recording of ${title}, ${bytes_in_words(bytes)}`}
          onClick={() => void app.player.open_sources(title, app.kept.sources_of(recording))}>Open, {bytes_in_words(bytes)}</button>
      </div>
      <p class="dim small" title={`Written last ${wall_time(written_at)}`}>
        {running ? 'Being written · ' : length_s === null ? '' : `${seconds(length_s)} · `}{has_states ? 'positions and events' : 'events alone: it was recorded without --record'}
      </p>
      <details>
        <summary class="small">Save its files</summary>
        <ul class="files">
          {files.map(({ name, bytes }) => (
            <li key={name}><a class="link mono" href={app.kept.address_of(recording, name)} download={`${recording.name}-${name}`}>{name}</a> <span class="dim mono">{bytes_in_words(bytes)}</span></li>
          ))}
        </ul>
      </details>
    </li>
  );
}
