// Starts `darzi lsp` for .garment files. Everything else is the server's.
"use strict";

const { workspace, window } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function program() {
  return workspace.getConfiguration("darzi").get("path") || "darzi";
}

async function start() {
  const command = program();
  const server = { command, args: ["lsp"] };
  client = new LanguageClient("darzi", "darzi", server, {
    documentSelector: [
      { scheme: "file", language: "garment" },
      { scheme: "untitled", language: "garment" },
    ],
  });
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    window.showErrorMessage(
      `\`${command} lsp\` does not start (${error.message}); set "darzi.path" to the program darzi`,
    );
  }
}

async function stop() {
  const running = client;
  client = undefined;
  if (running) await running.stop();
}

async function activate(context) {
  context.subscriptions.push(
    workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("darzi.path")) {
        await stop();
        await start();
      }
    }),
  );
  await start();
}

module.exports = { activate, deactivate: stop };
