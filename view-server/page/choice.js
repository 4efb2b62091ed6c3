// SPDX-License-Identifier: MIT
// A list of names to choose from, each with what it says of itself; the first one that is shown is
// what there is now.

export class Choice {
  /// `choose` takes the name that a person chose.
  constructor(list, choose) {
    Object.assign(this, { list, now: '' });
    list.addEventListener('change', () => {
      if (list.value && list.value !== this.now) choose(list.value);
    });
  }

  /// `all`: [{name, description}]; `now` may be a file of one's own, which has no name here.
  build(all = [], now = '') {
    this.now = now;
    const options = all.map(({ name, description }) => {
      const option = new Option(name, name);
      option.title = description;
      return option;
    });
    if (!all.some(({ name }) => name === now)) options.unshift(new Option(now, ''));
    this.list.replaceChildren(...options);
    this.reset();
  }

  /// What was chosen is not to be had.
  reset() {
    this.list.value = this.now;
    if (this.list.selectedIndex < 0) this.list.value = '';
  }
}
