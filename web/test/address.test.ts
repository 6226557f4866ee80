import { describe, expect, it } from 'vitest';
import { address_text, parse_address, type Address, type Place } from '../src/route/address';
import { Router, type AddressBar } from '../src/route/router';

const kPlaces: Place[] = [
  { page: 'cell' }, { page: 'new' }, { page: 'history' }, { page: 'settings' }, { page: 'job', id: 'a/b?c#d %' },
  { page: 'arm', name: 'links é' }, { page: 'pair', a: 'x/y', b: '<b>z</b>' }, { page: 'scene', name: null }, { page: 'scene', name: 'crate 1' },
];

describe('Address', () => {
  it('parses back to the same places for any name', () => {
    for (const place of kPlaces) {
      const address: Address = { place, t_s: 12.5, run: '7997886f', camera: [1, -2.5, 3, 0, 0, 0.4] };
      expect(parse_address(address_text(address))).toEqual(address);
    }
  });

  it('is short without time and camera', () => {
    expect(address_text({ place: { page: 'cell' }, t_s: null, run: null, camera: null })).toBe('#/');
    expect(parse_address('')).toEqual({ place: { page: 'cell' }, t_s: null, run: null, camera: null });
  });

  it('ignores invalid parts and maps unknown paths to the unknown page', () => {
    expect(parse_address('#/job/a?t=-1&camera=1,2,x,0,0,0').t_s).toBeNull();
    expect(parse_address('#/job/a?t=-1&camera=1,2,x,0,0,0').camera).toBeNull();
    expect(parse_address('#/?camera=1,2,3,4,5,6,7').camera).toBeNull();
    expect(parse_address('#/?camera=1,2,3,1,2,3').camera).toBeNull();
    expect(parse_address('#/?t=').t_s).toBeNull();
    expect(parse_address('#/?t=3&run=<b>').run).toBeNull();
    expect(parse_address('#/?run=7997886f').run).toBeNull();
    for (const hash of ['#/nothing', '#/job', '#/pair/a', '#/history/x']) expect(parse_address(hash).place.page).toBe('unknown');
    expect(parse_address('#/job/%E0%A4%A').place).toEqual({ page: 'job', id: '%E0%A4%A' });
  });
});

describe('Router', () => {
  const bar = (hash: string) => {
    const changes: string[] = [];
    let listener = () => {};
    const fake: AddressBar = {
      read: () => hash,
      push: (next) => { hash = next; changes.push(`push ${next}`); },
      replace: (next) => { hash = next; changes.push(`replace ${next}`); },
      on_change: (heard) => { listener = heard; },
    };
    return { fake, changes, back_to: (next: string) => { hash = next; listener(); } };
  };

  it('keeps time and camera between pages; only pages enter the browser history', () => {
    const { fake, changes } = bar('#/arm/left');
    const router = new Router(fake);
    expect(router.place).toEqual({ page: 'arm', name: 'left' });
    router.show_time(7.25);
    router.show_time(7.25);
    router.go({ page: 'job', id: 'a' });
    router.show_time(null);
    expect(changes).toEqual(['replace #/arm/left?t=7.25', 'push #/job/a?t=7.25', 'replace #/job/a']);
  });

  it('names the server session of a time', () => {
    const { fake, changes } = bar('#/');
    let stream: string | null = '7997886f-351f-4aa0-babd-42ad4e6d6ef7';
    const router = new Router(fake, () => stream);
    router.show_time(7.25);
    stream = null;
    router.go({ page: 'history' });
    router.show_time(3);
    expect(changes).toEqual(['replace #/?t=7.25&run=7997886f', 'push #/history?t=7.25&run=7997886f', 'replace #/history?t=3']);
  });

  it('follows the address bar', () => {
    const { fake, back_to } = bar('#/');
    const router = new Router(fake);
    back_to('#/scene/crate?t=3');
    expect(router.address.value).toEqual({ place: { page: 'scene', name: 'crate' }, t_s: 3, run: null, camera: null });
  });
});
