// Bundles the library that the planner carries into one module: node tools/make_carried.mjs FILE.
// Run it as `make carried`, which needs npm. Whose code that is, is told in web/carried.txt.

import { readFileSync } from "node:fs";
import { build } from "esbuild";

const LIBRARY = "smol-toml";

/** A package's name and version. @param {string} name */
function dated(name) {
  const text = readFileSync(new URL(`../node_modules/${name}/package.json`, import.meta.url), "utf-8");
  return `${name} ${JSON.parse(text).version}`;
}

await build({
  stdin: {
    contents: `export { parse, stringify, TomlDate, TomlError } from "${LIBRARY}";\n`,
    resolveDir: process.cwd(),
  },
  banner: { js: `// ${dated(LIBRARY)}, bundled by ${dated("esbuild")}: see carried.txt` },
  bundle: true,
  minifySyntax: true,
  charset: "utf8",
  format: "esm",
  target: "es2022",
  legalComments: "none",
  outfile: process.argv[2],
});
