import { describe, expect, it } from 'vitest';
import { curl_of, curl_to_post, python_of, python_to_post } from '../src/jobs/snippets';

const kOpen = { origin: 'http://127.0.0.1:8080', with_token: false };
const kGuarded = { ...kOpen, with_token: true };

describe('a job for programs', () => {
  it('is asked for by an address that a shell takes as it stands', () => {
    expect(curl_of({ id: "it's $(rm)" }, kOpen)).toBe("curl -s 'http://127.0.0.1:8080/api/v1/jobs/it'\\''s%20%24(rm)'");
  });

  it('takes the token from the environment where the server asks for one', () => {
    expect(curl_of({ id: 'a' }, kGuarded)).toContain('-H "Authorization: Bearer $ARMLOOM_TOKEN" ');
    expect(python_of({ id: 'a' }, kGuarded)).toContain('"Bearer " + os.environ["ARMLOOM_TOKEN"]');
    expect(python_of({ id: 'a' }, kOpen)).not.toContain('os');
  });

  it('is submitted by a text that ends where the job does, whatever is in it', () => {
    const curl = curl_to_post('/jobs', '{"name": "\nEND\nEND_"}', kOpen);
    expect(curl).toMatch(/<<'END__'\n[^]*\nEND__$/);
    expect(python_to_post('/jobs', String.raw`{"name": "'''\n"}`, kOpen)).toContain(String.raw`'''{"name": "\'\'\'\\n"}'''`);
  });
});
