export VKH_PARTITION=gpu VKH_TIME=60 VKH_GRES=gpu:1
tools/slurm/submit --wait list.jsonl results --tol 1e-6
