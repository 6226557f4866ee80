// The field for a job's text, which is typed, pasted or read from a file. If the text is long, only
// its beginning is shown. The whole text is checked and sent.

import { useState } from 'preact/hooks';
import { bytes_in_words } from '../wording';
import { read_job_file, too_large } from './job_file';
import { kText } from '../strings';
import { kLong } from './long_text';

const kWords = kText.compose;

const kBeginning = 2_000;

interface Props { text: string; change(text: string): void; send(): void }

export function TextField({ text, change, send }: Props) {
  const [fault, set_fault] = useState<string | null>(null);
  const paste = (event: ClipboardEvent) => {
    const pasted = event.clipboardData?.getData('text') ?? '';
    if (pasted.length <= kLong) return;
    event.preventDefault();  // a text field would take seconds for the layout of so long a text
    const large = too_large(kWords.pasted_text, pasted.length);
    set_fault(large);
    if (large === null) change(pasted);
  };
  return (
    <>
      {text.length > kLong ? <LongText text={text} clear={() => change('')} /> : (
        <textarea class="mono" spellcheck={false} aria-label={kWords.text_label} data-test="job-text" value={text}
          placeholder={'{\n  "trajectory": {\n    "joint_names": […],\n    "points": […]\n  }\n}'}
          onPaste={paste} onInput={(event) => { set_fault(null); change(event.currentTarget.value); }}
          onKeyDown={(event) => { if (event.key === 'Enter' && (event.ctrlKey || event.metaKey)) send(); }} />
      )}
      <div class="line">
        <FileButton change={change} report={set_fault} />
      </div>
      {fault !== null && <p class="refused" role="alert" data-test="file-fault">{fault}</p>}
    </>
  );
}

function LongText({ text, clear }: { text: string; clear(): void }) {
  return (
    <>
      <div class="line" data-test="long-text">
        <span class="grow small">{kWords.long_text(bytes_in_words(text.length))}</span>
        <button class="small" onClick={clear}>{kWords.clear}</button>
      </div>
      <pre class="mono" tabIndex={0} aria-label={kWords.long_text_label}>{text.slice(0, kBeginning)}…</pre>
    </>
  );
}

function FileButton({ change, report }: { change(text: string): void; report(fault: string | null): void }) {
  const open = async (input: HTMLInputElement) => {
    const file = input.files?.[0];
    if (!file) return;
    report(null);
    const read = await read_job_file(file);
    input.value = '';  // lets the user choose the same file again, after correcting it
    if (read.ok) change(read.text);
    else report(read.fault);
  };
  return (
    <label class="file small">
      <input type="file" accept=".json,application/json" data-test="file" class="sr-only" onChange={(event) => void open(event.currentTarget)} />
      {kWords.open_file}
    </label>
  );
}
