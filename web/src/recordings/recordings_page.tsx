// The Recordings page. It opens recordings of the server or from files, and exports recent data as
// MCAP.

import { useState } from 'preact/hooks';
import type { App } from '../state/app';
import { use_beats } from '../state/seen';
import { bytes_in_words, clock, seconds } from '../wording';
import { kText } from '../strings';
import { KeptRecordings } from './kept_recordings';

const kWords = kText.recordings;

export function RecordingsPage({ app }: { app: App }) {
  const { opened, fault } = app.player;
  return (
    <div class="page">
      <h2>{kText.page.recordings}</h2>
      {opened.value && (
        <div class="opened" role="status" data-test="opened">
          <p><b>{opened.value.name}</b>{kWords.opened(seconds(opened.value.last_s - opened.value.first_s), clock(opened.value.first_s), kWords.frames(opened.value.frames), opened.value.events, opened.value.unread)}</p>
          <p class="hint">{kWords.scrub_hint}</p>
          <button data-test="recording-close" onClick={() => app.player.close()}>{kText.common.back_to_live}</button>
        </div>
      )}
      <ReadingOn app={app} />
      {fault.value !== null && <p class="refused" role="alert" data-test="recording-fault">{fault.value}</p>}
      <KeptRecordings app={app} />
      <h3>{kWords.from_files}</h3>
      <p class="hint">
        {kWords.files_hint_folder}<code>armloom serve --data DIR</code>{kWords.files_hint_and}<code>armloom simulate --out DIR</code>
        {kWords.files_hint_choose}<code>states.csv</code>{kWords.files_hint_both}<code>events.jsonl</code>{kWords.files_hint_mcap}
      </p>
      <label class="drop">
        <input type="file" multiple accept=".csv,.jsonl,.json,.mcap" class="sr-only" data-test="recording-files"
          onChange={(event) => { if (event.currentTarget.files?.length) void app.player.open([...event.currentTarget.files]); }} />
        {kWords.choose_files}
      </label>
      <Export app={app} />
    </div>
  );
}

/** Shows the progress while a recording is read. */
function ReadingOn({ app: { player } }: { app: App }) {
  const reading = player.reading.value;
  if (!reading) return null;
  const { name, bytes, of_bytes } = reading;
  return (
    <div class="reading" data-test="reading">
      <label><b>{kWords.reading(name)}</b> <span class="dim mono">{kWords.bytes_of(bytes_in_words(bytes), bytes_in_words(of_bytes))}</span>
        <progress max={Math.max(1, of_bytes)} value={bytes} /></label>
      <button class="small" data-test="stop-reading" onClick={() => player.stop()}>{kWords.cancel}</button>
    </div>
  );
}

function Export({ app }: { app: App }) {
  use_beats(app.store);
  const [words, set_words] = useState('');
  const [writes, set_writes] = useState(false);
  const { trace } = app.store;
  const length_s = (trace.last_s ?? 0) - (trace.first_s ?? 0);
  const write = async () => {
    set_writes(true);
    set_words(kWords.writing);
    try {
      const { write_mcap } = await import('./mcap');
      const bytes = await write_mcap(app.store, (share) => set_words(kWords.writing_share(Math.round(100 * share))));
      save(bytes, `${app.store.cell?.name ?? 'armloom'}.mcap`);
      set_words(kWords.written(bytes_in_words(bytes.byteLength)));
    } catch (error) {
      set_words(kWords.not_written(String(error)));
    }
    set_writes(false);
  };
  return (
    <>
      <h3>{kWords.export}</h3>
      <p class="hint">{kWords.export_hint(app.player.opened.value ? kWords.the_recording : kWords.recent_data)}</p>
      <div class="line">
        <button data-test="export-mcap" disabled={length_s <= 0 || writes} onClick={() => void write()}>{kWords.export_button(seconds(length_s))}</button>
        <span class="dim small" role="status" data-test="export-words">{words}</span>
      </div>
    </>
  );
}

function save(bytes: Uint8Array<ArrayBuffer>, name: string): void {
  const address = URL.createObjectURL(new Blob([bytes], { type: 'application/octet-stream' }));
  const link = document.createElement('a');
  link.href = address;
  link.download = name;
  link.click();
  URL.revokeObjectURL(address);
}
