// Bundles each library that the planner carries into a module of a folder: node tools/make_carried.mjs FOLDER.
// Run it as `make carried`, which needs npm. Whose code that is, is told in web/carried.txt.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";

/** What is taken of each library, by the name of its module: Workers and page need one each. */
const MODULES = {
  "carried.js": { library: "smol-toml", names: ["parse", "stringify", "TomlDate", "TomlError"] },
  "carried_code.js": { library: "uqr", names: ["encode"] },
  "carried_zip.js": { library: "fflate", names: ["unzipSync"] },
};

/** A package's name and version. @param {string} name */
function dated(name) {
  const text = readFileSync(new URL(`../node_modules/${name}/package.json`, import.meta.url), "utf-8");
  return `${name} ${JSON.parse(text).version}`;
}

for (const [file, { library, names }] of Object.entries(MODULES)) {
  await build({
    stdin: {
      contents: `export { ${names.join(", ")} } from "${library}";\n`,
      resolveDir: process.cwd(),
    },
    banner: { js: `// ${dated(library)}, bundled by ${dated("esbuild")}: see carried.txt` },
    bundle: true,
    minifySyntax: true,
    charset: "utf8",
    format: "esm",
    target: "es2022",
    legalComments: "none",
    outfile: join(process.argv[2], file),
  });
}
