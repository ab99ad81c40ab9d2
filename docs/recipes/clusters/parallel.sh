parallel --jobs 1 --retries 3 'vkhausdorff batch list.jsonl --out results-{}.jsonl --shard {}/4 --resume || [ $? -lt 5 ]' ::: 0 1 2 3
vkhausdorff merge results-*.jsonl --list list.jsonl --out all.jsonl
