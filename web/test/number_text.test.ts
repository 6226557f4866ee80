import { describe, expect, it } from 'vitest';
import { no_number, number_in, stepped } from '../src/frame/number_text';

describe('Typed number', () => {
  it('is read as written, and never with a comma', () => {
    expect(['0.15', ' -0.9 ', '.5', '1e-3', '+2'].map(number_in)).toEqual([0.15, -0.9, 0.5, 0.001, 2]);
    expect(['0,15', '1,500', '', ' ', '5 mm', '--1', 'Infinity', 'NaN', '1e999'].map(number_in)).toEqual(Array(9).fill(null));
  });

  it('is explained if it is not a number', () => {
    expect(no_number(' 2,5')).toBe('"2,5" is not a number: use a decimal point');
    expect(no_number('wide')).toBe('"wide" is not a number');
  });

  it('is stepped without rounding digits, and unchanged if it is not a number', () => {
    expect(stepped('0.1', 0.2)).toBe('0.3');
    expect(stepped('-0.05', 0.05)).toBe('0');
    expect(stepped('0,1', 0.2)).toBe('0,1');
  });
});
