// Dialog that asks the user for the service's token.

import { byId } from './element.js';

/**
 * Returns a promise of the text that the user enters, or of null if the user cancels. wrong: whether the service has
 * rejected the previous token.
 */
export function askToken(wrong) {
  const dialog = byId('token-dialog'),
    form = byId('token-form'),
    input = byId('token-input');
  byId('token-wrong').hidden = !wrong;
  input.value = '';
  dialog.showModal();
  input.focus();
  return new Promise((resolve) => {
    let token = null;
    const cancel = () => dialog.close();
    const use = (event) => {
      event.preventDefault();
      token = input.value.trim();
      if (token !== '') dialog.close();
    };
    const closed = () => {
      form.removeEventListener('submit', use);
      byId('token-cancel').removeEventListener('click', cancel);
      input.value = '';
      resolve(token);
    };
    form.addEventListener('submit', use);
    byId('token-cancel').addEventListener('click', cancel);
    dialog.addEventListener('close', closed, { once: true });
  });
}
