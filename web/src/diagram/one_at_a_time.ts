// Questions that change faster than they are answered: one is under way at a time, and of those that came
// meanwhile only the last is asked. Every answer is told, so that there is one however fast they change.

export class OneAtATime<Question, Answer> {
  private asks_ = false;
  private next_: { question: Question } | null = null;
  private closed_ = false;

  constructor(private readonly ask_: (question: Question) => Promise<Answer>, private readonly tell_: (answer: Answer, question: Question) => void) {}

  want(question: Question): void {
    this.next_ = { question };
    if (!this.asks_) void this.go_on();
  }

  /** Nothing is told any more. */
  close(): void {
    this.closed_ = true;
    this.next_ = null;
  }

  private async go_on(): Promise<void> {
    this.asks_ = true;
    while (this.next_) {
      const { question } = this.next_;
      this.next_ = null;
      const answer = await this.ask_(question);
      if (!this.closed_) this.tell_(answer, question);
    }
    this.asks_ = false;
  }
}
