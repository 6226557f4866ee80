import { describe, expect, it } from 'vitest';
import { curl_of, curl_to_post, python_of, python_to_post } from '../src/jobs/snippets';

const kOpen = { origin: 'http://127.0.0.1:8080', with_token: false };
const kGuarded = { ...kOpen, with_token: true };

describe('Snippet of a job', () => {
  it('quotes the address for the shell', () => {
    expect(curl_of({ id: "it's $(rm)" }, kOpen)).toBe("curl -s 'http://127.0.0.1:8080/api/v1/jobs/it'\\''s%20%24(rm)'");
  });

  it('takes the token from the environment if the server requires one', () => {
    expect(curl_of({ id: 'a' }, kGuarded)).toContain('-H "Authorization: Bearer $ARMLOOM_TOKEN" ');
    expect(python_of({ id: 'a' }, kGuarded)).toContain('"Bearer " + os.environ["ARMLOOM_TOKEN"]');
    expect(python_of({ id: 'a' }, kOpen)).not.toContain('os');
  });

  it('submits any text safely', () => {
    const curl = curl_to_post('/jobs', '{"name": "\nEND\nEND_"}', kOpen);
    expect(curl).toMatch(/<<'END__'\n[^]*\nEND__$/);
    expect(python_to_post('/jobs', String.raw`{"name": "'''\n"}`, kOpen)).toContain(String.raw`'''{"name": "\'\'\'\\n"}'''`);
  });
});
