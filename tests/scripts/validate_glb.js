// Runs the Khronos glTF validator on files that we wrote; fails on any error or warning.
//
//   node validate_glb.js FOLDER_OF_NODE_MODULES FILE.glb...
const fs = require('fs');
const path = require('path');

const [tools, ...files] = process.argv.slice(2);
let validator;
try {
  validator = require(path.resolve(tools, 'gltf-validator'));
} catch (e) {
  console.error(`SKIPPED: no gltf-validator in ${tools}: tests/run.sh installs it`);
  process.exit(process.env.SGM_REQUIRE_ALL === '1' ? 1 : 77);
}

async function check(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 20 });
  const { numErrors, numWarnings, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ` +
              `${report.info.totalTriangleCount} triangles, ${report.info.totalVertexCount} vertices`);
  for (const m of messages) console.log(`  ${m.code} at ${m.pointer}: ${m.message}`);
  return numErrors + numWarnings === 0 && report.info.totalTriangleCount > 0;
}

(async () => {
  let good = files.length > 0;
  for (const file of files) good = (await check(file)) && good;
  process.exit(good ? 0 : 1);
})().catch((e) => { console.error(String(e)); process.exit(1); });
