// Runs one request at a time. While a request runs, only the last new request is kept. Every answer
// is delivered, so results appear even if requests change faster than the answers arrive.

export class OneAtATime<Question, Answer> {
  private asks_ = false;
  private next_: { question: Question } | null = null;
  private closed_ = false;

  constructor(private readonly ask_: (question: Question) => Promise<Answer>, private readonly deliver_: (answer: Answer, question: Question) => void) {}

  want(question: Question): void {
    this.next_ = { question };
    if (!this.asks_) void this.go_on();
  }

  /** Stops delivering answers. */
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
      if (!this.closed_) this.deliver_(answer, question);
    }
    this.asks_ = false;
  }
}
