// A button that copies text to the clipboard and says if that worked.

import { useState } from 'preact/hooks';
import { address_on_server } from '../server/api';
import type { App } from '../state/app';
import { kText } from '../strings';
import type { Asked } from './snippets';

const kStatus_ms = 1500;

export function Copy({ what, text }: { what: string; text(): string | Promise<string> }) {
  const [status, set_status] = useState('');
  const copy = async () => {
    set_status(await copied(await text()) ? kText.job.copied : kText.job.not_copied);
    setTimeout(() => set_status(''), kStatus_ms);
  };
  return (
    <button class="small" data-test={`copy-${what}`} onClick={() => void copy()}>
      {what === 'JSON' ? kText.job.copy_json(what) : kText.job.copy_as(what)}<span role="status">{status === '' ? '' : `: ${status}`}</span>
    </button>
  );
}

/** Returns how a program reaches the server of this page. */
export function asked_of(app: App): Asked {
  return { origin: address_on_server('').replace(/\/$/, ''), with_token: app.session.value?.auth_required ?? false };
}

/**
 * Copies a text; returns false if the browser forbids it. Browsers allow the clipboard API only on
 * HTTPS pages or on localhost. A panel at the cell is often neither, so an older method is tried
 * too.
 */
async function copied(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = document.createElement('textarea');
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand('copy');
    area.remove();
    return done;
  }
}
