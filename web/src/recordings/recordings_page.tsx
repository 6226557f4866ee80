// Recordings: those that the server has written, or one from files, are opened and looked at with the scrub
// bar; what the page has heard lately is written to a file that Foxglove reads.

import { useState } from 'preact/hooks';
import type { App } from '../state/app';
import { use_beats } from '../state/seen';
import { bytes_in_words, clock, seconds } from '../wording';
import { KeptRecordings } from './kept_recordings';

export function RecordingsPage({ app }: { app: App }) {
  const { opened, fault } = app.player;
  return (
    <div class="page">
      <h2>Recordings</h2>
      {opened.value && (
        <div class="opened" role="status" data-test="opened">
          <p><b>{opened.value.name}</b>: {seconds(opened.value.last_s - opened.value.first_s)} from {clock(opened.value.first_s)}, {opened.value.frames === 0 ? 'no positions' : `${opened.value.frames} pictures`}, {opened.value.events} events{opened.value.unread > 0 && `, ${opened.value.unread} of another version not read`}.</p>
          <p class="hint">The scrub bar below leads through it; all views show that instant.</p>
          <button data-test="recording-close" onClick={() => app.player.close()}>Back to the present</button>
        </div>
      )}
      <ReadingOn app={app} />
      {fault.value !== null && <p class="refused" role="alert" data-test="recording-fault">{fault.value}</p>}
      <KeptRecordings app={app} />
      <h3>From files</h3>
      <p class="hint">
        Drop a run's folder anywhere on the page, as <code>armloom serve --data DIR</code> and <code>armloom simulate --out DIR</code> write it; or
        choose <code>states.csv</code> and <code>events.jsonl</code> from it together, or an MCAP file that was exported here. Nothing leaves this browser.
      </p>
      <label class="drop">
        <input type="file" multiple accept=".csv,.jsonl,.json,.mcap" class="sr-only" data-test="recording-files"
          onChange={(event) => { if (event.currentTarget.files?.length) void app.player.open([...event.currentTarget.files]); }} />
        Choose the files, or drop them or their folder
      </label>
      <Export app={app} />
    </div>
  );
}

/** How much of one has come. */
function ReadingOn({ app: { player } }: { app: App }) {
  const reading = player.reading.value;
  if (!reading) return null;
  const { name, bytes, of_bytes } = reading;
  return (
    <div class="reading" data-test="reading">
      <label><b>Reading {name}</b> <span class="dim mono">{bytes_in_words(bytes)} of {bytes_in_words(of_bytes)}</span>
        <progress max={Math.max(1, of_bytes)} value={bytes} /></label>
      <button class="small" data-test="stop-reading" onClick={() => player.stop()}>Stop reading</button>
    </div>
  );
}

function Export({ app }: { app: App }) {
  use_beats(app.store);
  const [words, set_words] = useState('');
  const { trace } = app.store;
  const length_s = (trace.last_s ?? 0) - (trace.first_s ?? 0);
  const write = async () => {
    set_words('Writing…');
    try {
      const { write_mcap } = await import('./mcap');
      const bytes = await write_mcap(app.store, (share) => set_words(`Writing… ${Math.round(100 * share)} %`));
      save(bytes, `${app.store.cell?.name ?? 'armloom'}.mcap`);
      set_words(`Written: ${bytes_in_words(bytes.byteLength)}.`);
    } catch (error) {
      set_words(`It cannot be written: ${String(error)}`);
    }
  };
  return (
    <>
      <h3>Export</h3>
      <p class="hint">{app.player.opened.value ? 'The recording' : 'What this page has heard lately'} as an MCAP file for Foxglove: joint states, transforms of all links, the scene, jobs and events.</p>
      <div class="line">
        <button data-test="export-mcap" disabled={length_s <= 0 || words.startsWith('Writing')} onClick={() => void write()}>Export {seconds(length_s)} as MCAP</button>
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
