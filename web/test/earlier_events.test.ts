import { describe, expect, it } from 'vitest';
import { earlier_events } from '../src/server/earlier_events';
import { envelope, kStream, snapshot } from './samples';

const alert = (seq: number) => envelope('alert', seq, { level: 'info', text: `${seq}` });

/** Returns a server that sends these events, split anywhere, and then stays silent. */
function sending(texts: string[], asked: string[] = []) {
  return (url: string) => {
    asked.push(url);
    const bytes = new TextEncoder().encode(texts.map((text) => `id: x\ndata: ${text}\n\n: comment\n\n`).join(''));
    const body = new ReadableStream<Uint8Array>({
      start: (to) => { for (let i = 0; i < bytes.length; i += 77) to.enqueue(bytes.slice(i, i + 77)); },
    });
    return Promise.resolve(new Response(body));
  };
}

const seqs = async (texts: string[], until: number) => (await earlier_events('', sending(texts), kStream, until)).map(({ seq }) => seq);

describe('Earlier events', () => {
  it('are read until the page\'s own events begin, though the stream continues', async () => {
    expect(await seqs([alert(1), alert(2), alert(3), alert(4)], 3)).toEqual([1, 2, 3]);
  });

  it('are as many as the server keeps', async () => {
    const asked: string[] = [];
    await earlier_events('/api', sending([snapshot(9000, { gap: true })], asked), kStream, 9000);
    expect(asked).toEqual([4000, 8000].map((since) => `/api/events?stream=${kStream}&since=${since}`));
    asked.length = 0;
    await earlier_events('/api', sending([alert(300)], asked), kStream, 300);
    expect(asked).toEqual([`/api/events?stream=${kStream}&since=0`]);
  });

  it('are none if the server has forgotten them or there were none', async () => {
    expect(await seqs([snapshot(9, { gap: true })], 9)).toEqual([]);
    expect(await seqs([], 0)).toEqual([]);
  });

  it('are none if the server does not answer', async () => {
    expect(await earlier_events('', () => Promise.reject(new Error('lost')), kStream, 3)).toEqual([]);
  });
});
