// A Modbus TCP device by jsmodbus, for tests: as modbus_plc.py, but without `delay`.
//
//     node modbus_plc.mjs PORT
import { createRequire } from 'node:module';
import net from 'node:net';
import readline from 'node:readline';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const modbus = require('jsmodbus');

const kAddresses = 64;
const bits = () => Buffer.alloc(kAddresses / 8);
const registers = () => Buffer.alloc(2 * kAddresses);
const tables = { coil: bits(), discrete_input: bits(), holding_register: registers(), input_register: registers() };

function set(table, address, value) {
  const data = tables[table];
  if (data.length > kAddresses) return data.writeUInt16BE(value, 2 * address);
  const bit = 1 << (address % 8);
  data[address >> 3] = value ? data[address >> 3] | bit : data[address >> 3] & ~bit;
}

function get(table, address) {
  const data = tables[table];
  return data.length > kAddresses ? data.readUInt16BE(2 * address) : (data[address >> 3] >> (address % 8)) & 1;
}

const listening = net.createServer();
new modbus.server.TCP(listening, { coils: tables.coil, discrete: tables.discrete_input, holding: tables.holding_register, input: tables.input_register });
listening.listen(Number(process.argv[2]), '127.0.0.1', () => console.log('listens'));
readline.createInterface({ input: process.stdin }).on('line', (line) => {
  const [command, table, address, value] = line.split(' ');
  if (command === 'set') set(table, Number(address), Number(value));
  console.log(command === 'get' ? get(table, Number(address)) : 'done');
});
