import { describe, expect, it } from 'vitest';
import { kKinds, may_last, request_of, value_of } from '../src/frame/fault_request';

describe('request_of', () => {
  it('has a value and a duration only if the kind has them', () => {
    expect(request_of('left', 'stall', '7', ' ')).toEqual({ arm: 'left', kind: 'stall' });
    expect(request_of('left', 'drift', '-0.2', '1.5')).toEqual({ arm: 'left', kind: 'drift', value: -0.2, for_s: 1.5 });
    expect(request_of('left', 'reject', '', '2')).toEqual({ arm: 'left', kind: 'reject' });
  });
  it('is null if a text is not a number', () => {
    expect(request_of('left', 'drift', '0,2', '')).toBeNull();
    expect(request_of('left', 'stall', '', 'x')).toBeNull();
  });
  it('offers a usual value for each kind that has one', () => {
    expect(Object.keys(kKinds)).toHaveLength(18);
    expect(value_of('drift')?.usual).toBe(0.1);
    expect(value_of('cut')).toBeNull();
    expect(may_last('fault')).toBe(false);
  });
});
