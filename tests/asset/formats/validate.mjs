// Prints the report of Khronos' glTF validator on the files named on the command line, one JSON line each.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const validator = createRequire(import.meta.url)("gltf-validator");
for (const path of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)), { maxIssues: 20 });
  console.log(JSON.stringify(report));
}
