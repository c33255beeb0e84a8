// Sets view.json in FOLDER with a Typst template and writes FOLDER/certificate.pdf (PDF/A-3a).
// Usage: node render.mjs NODE_MODULES FOLDER TEMPLATE
// Exit status: 0 done; 3 Typst refused the document (the reason is on stdout); anything else: the installation.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';

const [modules, folder, template] = process.argv.slice(2);
const { NodeCompiler } = createRequire(path.join(modules, 'x.js'))('@myriaddreamin/typst-ts-node-compiler');

function refuse(messages) {
  console.log(messages.join('\n'));
  process.exit(3);
}

// The only files that the template can see are those of the folder.
fs.copyFileSync(template, path.join(folder, 'certificate.typ'));
const compiler = NodeCompiler.create({ workspace: folder });
const compiled = compiler.compile({ mainFilePath: path.join(folder, 'certificate.typ') });
const texts = (error) => (error ? compiler.fetchDiagnostics(error).map((d) => d.message) : []);
if (!compiled.result) refuse(texts(compiled.takeError()));
// A warning, such as a font that is not there, would change the look in silence.
const warnings = texts(compiled.takeWarnings());
if (warnings.length > 0) refuse(warnings);

let pdf;
try {
  pdf = compiler.pdf(compiled.result, { pdfStandard: 'a-3a' });
} catch (error) {
  refuse([...String(error.message).matchAll(/message: "((?:[^"\\]|\\.)*)"/g)].map((m) => m[1].replaceAll('\\"', '"'))
    .concat(String(error.message).includes('message: "') ? [] : [String(error.message)]));
}
fs.writeFileSync(path.join(folder, 'certificate.pdf'), pdf);
