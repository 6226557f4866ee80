// Files that are dropped anywhere on the page, which a browser would leave it for: a job, a bag of jobs or a
// trajectory goes to where jobs are composed, the files of a recording are opened.

import { signal } from '@preact/signals';
import type { App } from '../state/app';

/** Whether files are held over the page. */
export const files_over = signal(false);

export function listen_to_drops(app: App, window: Window): void {
  window.addEventListener('dragover', (event) => {
    if (!event.dataTransfer?.types.includes('Files')) return;  // text goes where it is dropped
    event.preventDefault();
    files_over.value = true;
  });
  window.addEventListener('dragleave', (event) => { if (event.relatedTarget === null) files_over.value = false; });
  window.addEventListener('drop', (event) => {
    files_over.value = false;
    const files = [...event.dataTransfer?.files ?? []];
    if (files.length === 0) return;
    event.preventDefault();
    void take(files, app);
  });
}

async function take(files: readonly File[], app: App): Promise<void> {
  const [first] = files;
  if (!first) return;
  if (files.some(({ name }) => /\.(csv|jsonl|mcap)$/.test(name))) {
    app.router.go({ page: 'recordings' });
    return app.player.open(files);
  }
  app.draft.value = await first.text();
  app.router.go({ page: 'new' });
}
