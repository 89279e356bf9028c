// The studio: the planner with its server's answers.

import { chosenBefore } from "./address.js";
import { ServerAnswers } from "./asking.js";
import { opened } from "./planner.js";
import { speak, useWords } from "./words.js";

const answers = new ServerAnswers();
speak((chosenBefore("lang") ?? navigator.language).startsWith("zh") ? "zh" : "en");
useWords(await answers.words());
opened(answers, await answers.presets(), null);
