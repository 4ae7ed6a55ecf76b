// Starts `sgm lsp` for grammars, and shows modules of the standard library, which are embedded in the command.
const vscode = require('vscode');
const { LanguageClient } = require('vscode-languageclient/node');

let client;

exports.activate = async (context) => {
  const command = vscode.workspace.getConfiguration('sgm').get('path');
  client = new LanguageClient(
    'sgm', 'SG+M grammars', { command, args: ['lsp'] },
    { documentSelector: [{ language: 'sgm', scheme: 'file' }] });
  context.subscriptions.push(vscode.workspace.registerTextDocumentContentProvider('sgm-std', {
    provideTextDocumentContent: (uri) => client.sendRequest('sgm/standardText', { uri: uri.toString() }),
  }));
  try {
    await client.start();
  } catch (error) {
    vscode.window.showErrorMessage(
      `SG+M: cannot start "${command} lsp": ${error.message}. Set sgm.path to the command sgm.`);
  }
};

exports.deactivate = () => client && client.stop();
