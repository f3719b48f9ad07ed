/** One question at a time, the newest next: what was asked in between is dropped, so that answers never lag behind. */
export class Latest<Question, Answer> {
  private running = false;
  private waiting: { question: Question } | null = null;

  constructor(
    private readonly ask: (question: Question) => Promise<Answer>,
    private readonly deliver: (answer: Answer, question: Question, newest: boolean) => void,
    private readonly fail: (error: unknown, question: Question) => void,
  ) {}

  get busy(): boolean {
    return this.running;
  }

  put(question: Question): void {
    this.waiting = { question };
    if (!this.running) void this.run();
  }

  /** Forgets what waits. */
  drop(): void {
    this.waiting = null;
  }

  private async run(): Promise<void> {
    this.running = true;
    while (this.waiting) {
      const { question } = this.waiting;
      this.waiting = null;
      try {
        const answer = await this.ask(question);
        this.deliver(answer, question, this.waiting === null);
      } catch (error) {
        this.fail(error, question);
      }
    }
    this.running = false;
  }
}
