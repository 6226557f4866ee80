import { signal } from '@preact/signals';
import { beforeEach, describe, expect, it } from 'vitest';
import { drop_fault, files_over, listen_to_drops } from '../src/frame/drops';
import type { Place } from '../src/route/address';
import type { App } from '../src/state/app';

const go_on = () => new Promise((done) => setTimeout(done));

/** Returns a page that records what it did, and a function that drops something on it. */
function page() {
  const opened: [names: string[], folder: string | null][] = [];
  const places: Place['page'][] = [];
  const draft = signal('');
  const app = {
    draft, router: { go: ({ page }: Place) => places.push(page) },
    player: { open: (files: readonly File[], folder: string | null) => { opened.push([files.map(({ name }) => name), folder]); return Promise.resolve(); } },
  } as unknown as App;
  const window = new EventTarget();
  listen_to_drops(app, window as unknown as Window);
  /**
   * Drops entries as browsers present a folder: a file that cannot be read, and an entry that can.
   */
  const drop = async (entries: readonly object[], files: readonly object[]) => {
    const event = Object.assign(new Event('drop', { cancelable: true }), { dataTransfer: { files, items: entries.map((entry) => ({ webkitGetAsEntry: () => entry })) } });
    window.dispatchEvent(event);
    await go_on();
    return event.defaultPrevented;
  };
  return { drop, draft, opened, places };
}

const entry_of = (file: File) => ({ isFile: true, isDirectory: false, name: file.name, file: (done: (file: File) => void) => done(file) });
const unreadable = { name: 'run', size: 4096, text: () => Promise.reject(new Error('NotFoundError')) };
/** Returns a folder whose reader returns two entries at a time. */
function folder_of(entries: readonly object[]) {
  return {
    isFile: false, isDirectory: true, name: 'run',
    createReader: () => {
      const left = [...entries];
      return { readEntries: (done: (some: object[]) => void) => done(left.splice(0, 2)) };
    },
  };
}

describe('Dropped files', () => {
  beforeEach(() => { drop_fault.value = null; });

  it('are a recording if they are a folder; all its files are found', async () => {
    const { drop, opened, places } = page();
    const files = ['summary.json', 'states.csv', 'jobs.json', 'notes.txt', 'events.jsonl'].map((name) => new File(['x'], name));
    expect(await drop([folder_of([folder_of([]), ...files.map(entry_of)])], [unreadable])).toBe(true);
    expect([opened, places, drop_fault.value]).toEqual([[[['states.csv', 'events.jsonl'], 'run']], ['recordings'], null]);
  });

  it('are reported if a folder has no recording', async () => {
    const { drop, opened, places } = page();
    await drop([folder_of([entry_of(new File(['{}'], 'jobs.json'))])], [unreadable]);
    expect([opened, places]).toEqual([[[[], 'run']], ['recordings']]);
  });

  it('are a job if they are one file of another kind', async () => {
    const { drop, draft, opened, places } = page();
    const file = new File(['{"id": "x"}'], 'job.json');
    files_over.value = true;
    await drop([entry_of(file)], [file]);
    expect([draft.value, opened, places, files_over.value, drop_fault.value]).toEqual(['{"id": "x"}', [], ['new'], false, null]);
  });

  it('are reported if they are not used', async () => {
    const { drop, draft } = page();
    const [first, second] = ['a.json', 'b.json'].map((name) => new File(['{}'], name));
    await drop([first, second].map((file) => entry_of(file!)), [first!, second!]);
    expect([draft.value, drop_fault.value]).toEqual(['{}', expect.stringContaining('Only a.json was read')]);
    await drop([{ isFile: true, isDirectory: false }], [unreadable]);
    expect(drop_fault.value).toMatch(/cannot be read: .*NotFoundError/);
  });

  it('are left to the browser if there is no file', async () => {
    const { drop, opened, places } = page();
    expect([await drop([], []), opened, places]).toEqual([false, [], []]);
  });
});
