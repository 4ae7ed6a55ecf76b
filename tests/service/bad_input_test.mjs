// Runs one group of tests with bad input, and checks the answers.
//
//   node bad_input_test.mjs GROUP BASE_URL OPERATIONS_URL PID WORK
import { Checks } from './http_probe.mjs';
import { rows as http } from './bad_input_http.mjs';
import { cramped, full, late, uploads } from './bad_input_uploads.mjs';
import { masters, token } from './bad_input_access.mjs';

const groups = { http, uploads, token, masters, full, late, cramped };
const [group, base, operations, pid, work] = process.argv.slice(2);
const checks = new Checks();
await groups[group]({ checks, base, operations, pid: Number(pid), work });
checks.finish();
