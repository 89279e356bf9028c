// Bundles each library that the planner carries into a module of a folder: node tools/make_carried.mjs FOLDER.
// Run it as `make carried`, which needs npm. Whose code that is, is told in web/carried.txt.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";

/** What is taken of which modules of a library, by the name of ours: Workers and page need one each. */
const MODULES = {
  "carried.js": { "smol-toml": ["parse", "stringify", "TomlDate", "TomlError"] },
  "carried_code.js": { uqr: ["encode"] },
  "carried_shapes.js": {
    "clipper2-ts/dist/Engine.js": ["Clipper64"],
    "clipper2-ts/dist/Offset.js": ["ClipperOffset"],
  },
  "carried_zip.js": { fflate: ["unzipSync"] },
};

/** A package's name and version. @param {string} name */
function dated(name) {
  const text = readFileSync(new URL(`../node_modules/${name}/package.json`, import.meta.url), "utf-8");
  return `${name} ${JSON.parse(text).version}`;
}

for (const [file, taken] of Object.entries(MODULES)) {
  const [library] = Object.keys(taken)[0].split("/");
  const exported = Object.entries(taken).map(
    ([module, names]) => `export { ${names.join(", ")} } from "${module}";\n`,
  );
  await build({
    stdin: {
      contents: exported.join(""),
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
