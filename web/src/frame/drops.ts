// Handles files dropped anywhere on the page; otherwise the browser would leave the page and show
// the file. Jobs open the New job page. A recording (files or folder) is opened.

import { signal } from '@preact/signals';
import { read_job_file } from '../compose/job_file';
import type { App } from '../state/app';
import { kText } from '../strings';

/** True while files are dragged over the page. */
export const files_over = signal(false);
/** Says why the dropped files were not accepted, until the user dismisses the message. */
export const drop_fault = signal<string | null>(null);

/** The files that were dropped. `folder` is the name of the dropped folder, or null. */
interface Dropped { files: readonly File[]; folder: string | null }

const kRecorded = /\.(csv|jsonl|mcap)$/;

export function listen_to_drops(app: App, window: Pick<Window, 'addEventListener'>): void {
  window.addEventListener('dragover', (event) => {
    if (!event.dataTransfer?.types.includes('Files')) return;  // dragged text is left to the field under it
    event.preventDefault();
    files_over.value = true;
  });
  window.addEventListener('dragleave', (event) => { if (event.relatedTarget === null) files_over.value = false; });
  window.addEventListener('drop', (event) => {
    files_over.value = false;
    const { dataTransfer } = event;
    if (!dataTransfer || dataTransfer.files.length === 0) return;
    event.preventDefault();
    drop_fault.value = null;
    // The files are read from the event now, because the browser forgets them after this event.
    void what_of(dataTransfer).then((dropped) => take(dropped, app)).catch((error: unknown) => { drop_fault.value = kText.frame.drop_unreadable(String(error)); });
  });
}

async function take({ files, folder }: Dropped, app: App): Promise<void> {
  if (folder !== null || files.some(({ name }) => kRecorded.test(name))) {
    app.router.go({ page: 'recordings' });
    return app.player.open(files, folder);
  }
  const [first] = files;
  if (!first) return;
  const read = await read_job_file(first);
  if (!read.ok) {
    drop_fault.value = read.fault;
    return;
  }
  app.draft.value = read.text;
  app.router.go({ page: 'new' });
  if (files.length > 1) drop_fault.value = kText.frame.only_one_file(first.name);
}

/**
 * Returns the dropped files. If a folder was dropped, returns its recording files, without
 * subfolders.
 */
function what_of({ items, files }: DataTransfer): Promise<Dropped> {
  const folder = [...items].map((item) => item.webkitGetAsEntry()).find((entry) => entry?.isDirectory);
  return folder ? in_folder(folder as FileSystemDirectoryEntry) : Promise.resolve({ files: [...files], folder: null });
}

async function in_folder(folder: FileSystemDirectoryEntry): Promise<Dropped> {
  const reader = folder.createReader();
  const files: File[] = [];
  // The reader returns some entries at a time; an empty list is the end.
  for (let some = await next_of(reader); some.length > 0; some = await next_of(reader)) {
    for (const entry of some) if (entry.isFile && kRecorded.test(entry.name)) files.push(await file_of(entry as FileSystemFileEntry));
  }
  return { files, folder: folder.name };
}

function next_of(reader: FileSystemDirectoryReader): Promise<FileSystemEntry[]> {
  return new Promise((done, fail) => reader.readEntries(done, fail));
}

function file_of(entry: FileSystemFileEntry): Promise<File> {
  return new Promise((done, fail) => entry.file(done, fail));
}
