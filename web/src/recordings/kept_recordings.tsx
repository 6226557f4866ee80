// The server's recordings, to open here or to download.

import { useEffect, useState } from 'preact/hooks';
import type { KeptRecording } from '../server/messages';
import type { App } from '../state/app';
import { short_wall_time, wall_time } from '../wall_time';
import { bytes_in_words, seconds } from '../wording';
import { kText } from '../strings';
import { length_s_of, title_of_recording } from './kept_list';

const kWords = kText.recordings;

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
      <h3>{kWords.on_server}{list?.kept && <span class="count">{list.recordings.length}</span>}<span class="spacer" />
        {list?.kept && <button class="small" data-test="recordings-again" onClick={() => void kept.look()}>{kWords.refresh}</button>}</h3>
      {fault !== null && <p class="refused" role="alert">{kWords.no_list(fault)}</p>}
      {list && !list.kept && <p class="hint" data-test="not-kept">{kWords.not_recording}<code>armloom serve --data DIR</code>{kWords.not_recording_data}<code>--record</code>{kWords.not_recording_positions}</p>}
      {list?.kept && (
        <ul class="kept" data-test="kept-recordings">
          {list.recordings.slice(0, shown).map((recording) => <Kept key={recording.name} app={app} recording={recording} />)}
        </ul>
      )}
      {list && list.recordings.length > shown && <button class="small" onClick={() => set_shown(shown + 5 * kShown)}>{kWords.earlier(list.recordings.length - shown)}</button>}
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
        <button class="small" data-test="open-recording" disabled={app.player.reading.value !== null} aria-label={kWords.open_label(title, bytes_in_words(bytes))}
          onClick={() => void app.player.open_sources(title, app.kept.sources_of(recording))}>{kWords.open(bytes_in_words(bytes))}</button>
      </div>
      <p class="dim small" title={kWords.last_written(wall_time(written_at))}>
        {running ? kWords.being_written : length_s === null ? '' : `${seconds(length_s)} · `}{has_states ? kWords.with_positions : kWords.events_only}
      </p>
      <details>
        <summary class="small">{kWords.save_files}</summary>
        <ul class="files">
          {files.map(({ name, bytes }) => (
            <li key={name}><a class="link mono" href={app.kept.address_of(recording, name)} download={`${recording.name}-${name}`}>{name}</a> <span class="dim mono">{bytes_in_words(bytes)}</span></li>
          ))}
        </ul>
      </details>
    </li>
  );
}
